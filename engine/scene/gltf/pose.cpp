#include "engine/scene/gltf/pose.h"

#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/nodes.h"
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

namespace irradia::gltf {

Pose poseOf(const tinygltf::Mesh& mesh) {
    return {mesh.weights, {}, false};
}

Pose poseOf(const tinygltf::Model& model, const tinygltf::Node& node) {
    return {node.weights.empty() ? model.meshes[node.mesh].weights : node.weights, {}, false};
}

SkinPlace placeSkin(const tinygltf::Model& model, const tinygltf::Skin& skin,
                    const std::vector<glm::dmat4>& worlds) {
    const glm::dvec3 first(worlds[skin.joints.front()][3]);
    const glm::dvec3 anchor = isFinite(first) ? first : glm::dvec3(0.0);
    std::optional<AccessorView> inverses;
    if (skin.inverseBindMatrices >= 0) inverses.emplace(model, skin.inverseBindMatrices);

    SkinPlace place;
    place.toWorld = glm::translate(glm::dmat4(1.0), anchor);
    for (size_t i = 0; i < skin.joints.size(); ++i) {
        glm::dmat4 joint = worlds[skin.joints[i]];
        joint[3] -= glm::dvec4(anchor, 0.0);
        place.joints.push_back(inverses ? joint * glm::dmat4(inverses->matrix(i)) : joint);
    }
    return place;
}

} // namespace irradia::gltf
