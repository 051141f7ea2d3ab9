// Lights of KHR_lights_punctual, where nodes place them.
#pragma once

#include "engine/scene/gltf/nodes.h"

namespace irradia::gltf {

// The light that a node places, -1 where it places none. The model need not have been validated.
int lightOf(const tinygltf::Node& node);

// Those of the placed nodes that shine, in the file's node order. Scales move lights, but make none stronger
// or wider.
std::vector<PunctualLight> placeLights(const SourceFile& source, const tinygltf::Model& model,
                                       const std::vector<Placement>& nodes);

// World positions of what has one.
std::vector<glm::dvec3> lightPositions(const tinygltf::Model& model, const std::vector<Placement>& nodes);

} // namespace irradia::gltf
