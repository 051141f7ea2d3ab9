// Which parts of glTF and of its extensions are read, and the one warning each for those that are not.
#pragma once

#include "engine/scene/gltf_file.h"
#include "engine/scene/gltf_model.h"
#include "engine/scene/scene.h"
#include <string>
#include <vector>

namespace irradia::gltf {

// Throws BadData naming the first extension a file cannot be read without and that is not known here.
void refuseUnknownExtensions(const SourceFile& source, const std::vector<std::string>& required);

// One warning for each feature the file uses and the renderer leaves out.
void noteIgnoredFeatures(const tinygltf::Model& model, SceneNotes& notes);

// Adds a warning unless the same one is there, or too many are.
void warnOnce(SceneNotes& notes, const std::string& warning);

} // namespace irradia::gltf
