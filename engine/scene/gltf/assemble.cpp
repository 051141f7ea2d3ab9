#include "engine/scene/gltf/assemble.h"

#include "engine/scene/gltf/features.h"
#include "engine/scene/gltf/instances.h"
#include "engine/scene/gltf/lights.h"
#include "engine/scene/gltf/materials.h"
#include "engine/scene/gltf/nodes.h"
#include "engine/scene/gltf/shown_meshes.h"
#include "engine/scene/scene_origin.h"
#include <algorithm>

namespace irradia::gltf {
namespace {

// What a scene may hold. A small file can ask for far more: by instancing, or by accessors without data.
constexpr uint64_t kMaxTriangles = 1ull << 25;
constexpr uint64_t kMaxVertices = 1ull
                                  << 28; // named by primitives, before those no triangle uses are left out

struct MeshSize {
    uint64_t triangles = 0;
    uint64_t vertices = 0; // to be read, those of morph targets included
};

MeshSize sizeOf(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
    MeshSize size;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        size.triangles += triangleCount(model, primitive);
        size.vertices += vertexCount(model, primitive) * (1 + primitive.targets.size());
    }
    return size;
}

// Counts before anything is built.
void refuseTooMany(const SourceFile& source, const tinygltf::Model& model,
                   const std::vector<Placement>& nodes) {
    std::vector<MeshSize> sizes;
    uint64_t vertices = 0, triangles = 0;
    for (const tinygltf::Mesh& mesh : model.meshes)
        vertices += sizes.emplace_back(sizeOf(model, mesh)).vertices;
    const auto capped = [](uint64_t count) { return std::min(count, kMaxTriangles + 1); };
    for (const Placement& placement : nodes) {
        const tinygltf::Node& node = model.nodes[placement.node];
        if (node.mesh < 0) continue;
        const MeshSize& size = sizes[node.mesh];
        if (node.skin >= 0 || !node.weights.empty()) vertices += size.vertices; // read for this node alone
        triangles += capped(size.triangles) * capped(Instancing(model, node).count());
        if (triangles > kMaxTriangles)
            source.refuse("{}: with it the scene has more than the {} triangles allowed",
                          label("node", placement.node, node.name), kMaxTriangles);
    }
    if (vertices > kMaxVertices)
        source.refuse("the meshes have more than the {} vertices allowed", kMaxVertices);
}

// World positions of vertices, or of every k-th where there are more than a median needs.
std::vector<glm::dvec3> somePositions(const ShownMeshes& meshes) {
    constexpr uint64_t kMost = 1u << 20;
    uint64_t count = 0;
    meshes.forEach(
        [&](const PrimitiveMesh& primitive, const glm::dmat4&) { count += primitive.vertices.size(); });
    const uint64_t step = count / kMost + 1;
    std::vector<glm::dvec3> positions;
    uint64_t skip = 0;
    meshes.forEach([&](const PrimitiveMesh& primitive, const glm::dmat4& toWorld) {
        const uint64_t vertices = primitive.vertices.size();
        for (; skip < vertices; skip += step) {
            const glm::dvec3 p(toWorld * glm::dvec4(primitive.vertices[skip].position, 1.0));
            if (isFinite(glm::vec3(p))) positions.push_back(p); // what is beyond floats takes no part
        }
        skip -= vertices;
    });
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
    const ShownMeshes meshes(source, model, nodes, scene);
    std::vector<glm::dvec3> positions = somePositions(meshes);
    if (positions.empty()) positions = lightPositions(model, nodes);
    scene.origin = sceneOrigin(positions);
    meshes.forEach([&](const PrimitiveMesh& primitive, glm::dmat4 toWorld) {
        toWorld[3] -= glm::dvec4(scene.origin, 0.0);
        appendInstance(primitive, toWorld, scene);
    });
    for (Placement& placement : nodes) placement.toWorld[3] -= glm::dvec4(scene.origin, 0.0);
    scene.cameras = placeCameras(source, model, nodes);
    scene.lights = placeLights(source, model, nodes);
    for (const Finding& finding : source.findings->all()) scene.notes.warnings.push_back(finding.message);
    return scene;
}

} // namespace irradia::gltf
