// Faults that a renderer can live with, as warnings. Those of accessors and animations cost more to find than
// a load should take: they are for validation alone.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"

namespace irradia::gltf {

// Alignment of accessors, their bounds beside the data, directions that are no unit vectors. The data have
// passed validateModel.
void inspectAccessors(const SourceFile& source, const tinygltf::Model& model);

// What animations move, though they are not played. The JSON has been parsed into the model.
void inspectAnimations(const SourceFile& source, const tinygltf::Model& model);

// Values of another JSON type than glTF has there, which are taken for absent. The text is that of an object
// that has passed the guard.
void inspectTypes(const SourceFile& source);

} // namespace irradia::gltf
