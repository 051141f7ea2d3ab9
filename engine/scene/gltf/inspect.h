// Faults that a renderer can live with, and which cost more to find than a load should take: for validation
// alone, as warnings.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"

namespace irradia::gltf {

// Alignment of accessors, their bounds beside the data, directions that are no unit vectors. The data have
// passed validateModel.
void inspectAccessors(const SourceFile& source, const tinygltf::Model& model);

// What animations move, though they are not played. The JSON has been parsed into the model.
void inspectAnimations(const SourceFile& source, const tinygltf::Model& model);

} // namespace irradia::gltf
