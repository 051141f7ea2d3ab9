// From the file's bytes to tinygltf's model, with its buffers loaded and its pictures still encoded.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/json_guard.h"
#include "engine/scene/gltf/model.h"

namespace irradia::gltf {

// The JSON alone, as text: another format, broken JSON and extensions without which nothing can be read are
// refused. Notes what is left out.
JsonFindings readJson(const SourceFile& source);

// Throws BadData for broken files, NotFound for missing buffers. Indices in the model are unchecked: validate
// next; where errors are collected and there was one, the model is not whole.
tinygltf::Model parseModel(const SourceFile& source, const JsonFindings& findings);

} // namespace irradia::gltf
