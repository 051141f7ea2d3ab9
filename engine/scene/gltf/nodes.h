// The node hierarchy, flattened: which meshes and cameras stand where in the world.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"
#include "engine/scene/scene.h"
#include <glm/glm.hpp>
#include <vector>

namespace irradia::gltf {

struct Placement {
    int node = 0;
    glm::dmat4 toWorld{1.0};
};

// Every node of the file's default scene (else its first; else of all root nodes), parents before children.
std::vector<Placement> placeNodes(const tinygltf::Model& model);

// Whether every number is finite.
bool isFinite(glm::dvec3 v);

// Cameras of the placed nodes, in the file's node order.
std::vector<Camera> placeCameras(const SourceFile& source, const tinygltf::Model& model,
                                 const std::vector<Placement>& nodes);

} // namespace irradia::gltf
