// How a node's mesh stands at rest: its morph targets' weights, and the joints of its skin.
#pragma once

#include "engine/scene/gltf/model.h"
#include <glm/glm.hpp>
#include <vector>

namespace irradia::gltf {

struct Pose {
    std::vector<double> weights;    // of morph targets; missing ones are 0
    std::vector<glm::dmat4> joints; // from the mesh to the pose's own place; empty = no skin
    bool mirrors = false;           // the joints turn fronts to backs
};

// A mesh that no node shows.
Pose poseOf(const tinygltf::Mesh& mesh);

// The same as a node shows it, skin aside.
Pose poseOf(const tinygltf::Model& model, const tinygltf::Node& node);

// Joints and the place of a skin about its first joint, so that floats resolve it. `worlds` are the nodes'
// transforms. (The transform of the node that shows a skinned mesh does not count: glTF 2.0, 3.7.3.3.)
struct SkinPlace {
    std::vector<glm::dmat4> joints;
    glm::dmat4 toWorld{1.0};
};
SkinPlace placeSkin(const tinygltf::Model& model, const tinygltf::Skin& skin,
                    const std::vector<glm::dmat4>& worlds);

} // namespace irradia::gltf
