// Every index and every range of a model, checked in 64 bits before anything is read through it. Errors carry
// the codes of Khronos' glTF validator.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"

namespace irradia::gltf {

// Throws BadData at the first fault of a buffer view, accessor, mesh, material, texture, image, skin, node or
// scene.
void validateModel(const SourceFile& source, const tinygltf::Model& model);

} // namespace irradia::gltf
