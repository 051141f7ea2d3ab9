// Materials and the pictures they use.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"
#include "engine/scene/scene.h"

namespace irradia::gltf {

// Appends the file's materials, in its order, and glTF's default material last where a primitive names none;
// decodes the pictures in use.
// Factors outside their range are clamped with a warning.
void readMaterials(const SourceFile& source, const tinygltf::Model& model, Scene& scene);

} // namespace irradia::gltf
