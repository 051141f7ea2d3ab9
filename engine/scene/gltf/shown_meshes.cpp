#include "engine/scene/gltf/shown_meshes.h"

#include "engine/scene/gltf/pose.h"

namespace irradia::gltf {

ShownMeshes::ShownMeshes(const SourceFile& source, const tinygltf::Model& model,
                         const std::vector<Placement>& nodes, const Scene& scene) {
    std::vector<glm::dmat4> worlds; // of all nodes, where there is a skin
    if (!model.skins.empty()) worlds = worldTransforms(model);
    for (const Placement& placement : nodes) {
        const tinygltf::Node& node = model.nodes[placement.node];
        if (node.mesh < 0) continue;
        const bool hasOwnPose = node.skin >= 0 || !node.weights.empty();
        const PosedMesh key(node.mesh, hasOwnPose ? placement.node : -1);
        Pose pose = poseOf(model, node);
        glm::dmat4 toWorld = placement.toWorld;
        if (node.skin >= 0) {
            SkinPlace place = placeSkin(model, model.skins[node.skin], worlds);
            pose.mirrors = glm::determinant(glm::dmat3(place.joints.front())) < 0;
            pose.joints = std::move(place.joints);
            toWorld = place.toWorld;
        }
        if (!meshes_.contains(key)) meshes_[key] = readMesh(source, model, node.mesh, pose, scene);
        shown_.push_back({&meshes_.at(key), toWorld, node.skin < 0 ? Instancing(model, node) : Instancing()});
    }
}

} // namespace irradia::gltf
