#include "engine/scene/load_scene.h"

#include "engine/scene/gltf_features.h"
#include "engine/scene/gltf_instances.h"
#include "engine/scene/gltf_materials.h"
#include "engine/scene/gltf_nodes.h"
#include "engine/scene/gltf_parse.h"
#include "engine/scene/gltf_validate.h"
#include <map>
#include <new>

namespace irradia {
namespace {

// 64 million triangles are 10 GiB with their acceleration structure; a small file can ask for more by
// instancing.
constexpr uint64_t kMaxTriangles = 1ull << 26;

// FNV-1a, 64 bits (Fowler, Noll and Vo).
uint64_t hashBytes(const std::vector<uint8_t>& bytes) {
    uint64_t hash = 0xcbf29ce484222325ull;
    for (const uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001b3ull;
    return hash;
}

// Counts before anything is built: a hostile file may multiply meshes by nodes.
void refuseTooMany(const gltf::SourceFile& source, const tinygltf::Model& model,
                   const std::vector<gltf::Placement>& nodes) {
    uint64_t triangles = 0;
    for (const gltf::Placement& placement : nodes) {
        const int mesh = model.nodes[placement.node].mesh;
        if (mesh < 0) continue;
        for (const tinygltf::Primitive& primitive : model.meshes[mesh].primitives)
            triangles += gltf::triangleCount(model, primitive);
        if (triangles > kMaxTriangles)
            source.refuse("{}: with it the scene has more than the {} triangles allowed",
                          gltf::label("node", placement.node, model.nodes[placement.node].name),
                          kMaxTriangles);
    }
}

void appendMeshes(const gltf::SourceFile& source, const tinygltf::Model& model,
                  const std::vector<gltf::Placement>& nodes, Scene& scene) {
    std::map<int, std::vector<gltf::PrimitiveMesh>> meshes; // read once, placed by every node that names it
    for (const gltf::Placement& placement : nodes) {
        const int mesh = model.nodes[placement.node].mesh;
        if (mesh < 0) continue;
        if (!meshes.contains(mesh)) meshes[mesh] = gltf::readMesh(source, model, mesh, scene);
        for (const gltf::PrimitiveMesh& primitive : meshes[mesh])
            gltf::appendInstance(primitive, placement.toWorld, scene);
    }
}

Scene readScene(const std::filesystem::path& file) {
    const gltf::SourceFile source = gltf::openSource(file);
    Scene scene;
    scene.name = file.stem().string();
    scene.contentHash = hashBytes(source.bytes);

    const tinygltf::Model model = gltf::parseModel(source, scene.notes);
    gltf::validateModel(source, model);
    gltf::noteIgnoredFeatures(model, scene.notes);

    const std::vector<gltf::Placement> nodes = gltf::placeNodes(model);
    refuseTooMany(source, model, nodes);
    gltf::readMaterials(source, model, scene);
    appendMeshes(source, model, nodes, scene);
    scene.cameras = gltf::placeCameras(model, nodes, scene.notes);
    return scene;
}

} // namespace

Scene loadScene(const std::filesystem::path& file) {
    try {
        return readScene(file);
    } catch (const std::bad_alloc&) {
        fail(ExitCode::OutOfMemory, "{}: not enough memory to load the scene", file.string());
    }
}

} // namespace irradia
