// From a model that has passed validateModel to the scene: materials, pictures, instances, cameras,
// lights.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"
#include "engine/scene/scene.h"

namespace irradia::gltf {

// Throws BadData for what can only be told in reading: pictures, indices, too many triangles. What has been
// found so far and what is left out become the scene's warnings.
Scene assembleScene(const SourceFile& source, const tinygltf::Model& model);

} // namespace irradia::gltf
