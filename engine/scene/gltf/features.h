// Which parts of glTF and of its extensions are read, and the one warning each for those that are not.
#pragma once

#include "engine/scene/gltf/json_guard.h"
#include "engine/scene/gltf/model.h"
#include "engine/scene/scene.h"
#include <string>

namespace irradia::gltf {

// Throws BadData naming the first required extension without which the file cannot be read, or of which
// nothing is known here.
void refuseUnreadableExtensions(const SourceFile& source, const JsonFindings& findings);

// Warnings for the extensions that are left out, required ones among them, and for undeclared ones.
void noteExtensions(const JsonFindings& findings, SceneNotes& notes);

// One warning for each feature of glTF itself that the file uses and the renderer leaves out.
void noteIgnoredFeatures(const tinygltf::Model& model, SceneNotes& notes);

// Adds a warning unless the same one is there, or too many are.
void warnOnce(SceneNotes& notes, const std::string& warning);

} // namespace irradia::gltf
