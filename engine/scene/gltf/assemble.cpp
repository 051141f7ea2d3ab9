#include "engine/scene/gltf/assemble.h"

#include "engine/scene/gltf/features.h"
#include "engine/scene/gltf/instances.h"
#include "engine/scene/gltf/lights.h"
#include "engine/scene/gltf/materials.h"
#include "engine/scene/gltf/nodes.h"
#include "engine/scene/scene_origin.h"
#include <cmath>
#include <map>

namespace irradia::gltf {
namespace {

// What a scene may hold. A small file can ask for far more: by instancing, or by accessors without data.
constexpr uint64_t kMaxTriangles = 1ull << 25;
constexpr uint64_t kMaxVertices = 1ull
                                  << 28; // named by primitives, before those no triangle uses are left out

// Counts before anything is built.
void refuseTooMany(const SourceFile& source, const tinygltf::Model& model,
                   const std::vector<Placement>& nodes) {
    std::vector<uint64_t> meshTriangles;
    uint64_t vertices = 0, triangles = 0;
    for (const tinygltf::Mesh& mesh : model.meshes) {
        uint64_t& count = meshTriangles.emplace_back(0);
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            count += triangleCount(model, primitive);
            vertices += vertexCount(model, primitive);
        }
    }
    if (vertices > kMaxVertices)
        source.refuse("the meshes have more than the {} vertices allowed", kMaxVertices);
    for (const Placement& placement : nodes) {
        const tinygltf::Node& node = model.nodes[placement.node];
        if (node.mesh >= 0) triangles += meshTriangles[node.mesh];
        if (triangles > kMaxTriangles)
            source.refuse("{}: with it the scene has more than the {} triangles allowed",
                          label("node", placement.node, node.name), kMaxTriangles);
    }
}

// Read once, placed by every node that names it. A node without a mesh has mesh -1, without primitives.
using Meshes = std::map<int, std::vector<PrimitiveMesh>>;

Meshes readMeshes(const SourceFile& source, const tinygltf::Model& model, const std::vector<Placement>& nodes,
                  const Scene& scene) {
    Meshes meshes{{-1, {}}};
    for (const Placement& placement : nodes) {
        const int mesh = model.nodes[placement.node].mesh;
        if (!meshes.contains(mesh)) meshes[mesh] = readMesh(source, model, mesh, scene);
    }
    return meshes;
}

// World positions of vertices, or of every k-th where there are more than a median needs.
std::vector<glm::dvec3> somePositions(const tinygltf::Model& model, const std::vector<Placement>& nodes,
                                      const Meshes& meshes) {
    constexpr uint64_t kMost = 1u << 20;
    uint64_t count = 0;
    for (const Placement& placement : nodes)
        for (const PrimitiveMesh& primitive : meshes.at(model.nodes[placement.node].mesh))
            count += primitive.vertices.size();
    const uint64_t step = count / kMost + 1;
    std::vector<glm::dvec3> positions;
    uint64_t skip = 0;
    for (const Placement& placement : nodes)
        for (const PrimitiveMesh& primitive : meshes.at(model.nodes[placement.node].mesh)) {
            const uint64_t vertices = primitive.vertices.size();
            for (; skip < vertices; skip += step) {
                const glm::dvec3 p(placement.toWorld * glm::dvec4(primitive.vertices[skip].position, 1.0));
                const glm::vec3 single(p); // what is beyond floats takes no part
                if (std::isfinite(single.x + single.y + single.z)) positions.push_back(p);
            }
            skip -= vertices;
        }
    return positions;
}

// The file itself and those it names: its buffers, and its pictures whether used or not.
std::vector<std::filesystem::path> filesOf(const SourceFile& source, const tinygltf::Model& model) {
    std::vector<std::filesystem::path> files{source.path};
    const auto add = [&](const std::string& uri) {
        const bool isBeside = !uri.empty() && uri.find(':') == std::string::npos; // else in the file itself
        if (isBeside) files.push_back(source.path.parent_path() / relativePath(source, decodeUri(uri)));
    };
    for (const tinygltf::Buffer& buffer : model.buffers) add(buffer.uri);
    for (const tinygltf::Image& image : model.images) add(image.uri);
    return files;
}

// FNV-1a, 64 bits (Fowler, Noll and Vo).
uint64_t hashBytes(const std::vector<uint8_t>& bytes) {
    uint64_t hash = 0xcbf29ce484222325ull;
    for (const uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001b3ull;
    return hash;
}

} // namespace

Scene assembleScene(const SourceFile& source, const tinygltf::Model& model) {
    Scene scene;
    scene.name = source.path.stem().string();
    scene.contentHash = hashBytes(source.bytes);
    scene.files = filesOf(source, model);
    noteIgnoredFeatures(source, model);

    std::vector<Placement> nodes = placeNodes(model);
    refuseTooMany(source, model, nodes);
    readMaterials(source, model, scene);
    const Meshes meshes = readMeshes(source, model, nodes, scene);
    std::vector<glm::dvec3> positions = somePositions(model, nodes, meshes);
    if (positions.empty()) positions = lightPositions(model, nodes);
    scene.origin = sceneOrigin(positions);
    for (Placement& placement : nodes) {
        placement.toWorld[3] -= glm::dvec4(scene.origin, 0.0);
        for (const PrimitiveMesh& primitive : meshes.at(model.nodes[placement.node].mesh))
            appendInstance(primitive, placement.toWorld, scene);
    }
    scene.cameras = placeCameras(source, model, nodes);
    scene.lights = placeLights(source, model, nodes);
    for (const Finding& finding : source.findings->all()) scene.notes.warnings.push_back(finding.message);
    return scene;
}

} // namespace irradia::gltf
