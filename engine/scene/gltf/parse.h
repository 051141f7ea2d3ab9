// From the file's bytes to tinygltf's model, with its buffers loaded and its pictures still encoded.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"
#include "engine/scene/scene.h"

namespace irradia::gltf {

// Throws BadData for broken files, NotFound for missing buffers. Indices in the model are unchecked: validate
// next.
tinygltf::Model parseModel(const SourceFile& source, SceneNotes& notes);

} // namespace irradia::gltf
