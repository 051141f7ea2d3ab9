// Which parts of glTF and of its extensions are read, and the one note each for those that are not.
#pragma once

#include "engine/scene/gltf/json_guard.h"
#include "engine/scene/gltf/model.h"
#include <string>
#include <vector>

namespace irradia::gltf {

// Throws BadData naming the first required extension without which the file cannot be read, or of which
// nothing is known here.
void refuseUnreadableExtensions(const SourceFile& source, const JsonFindings& findings);

enum class Support {
    Read,    // those that change nothing in a picture are among them
    Ignored, // known to change the picture, and left out of it
    Unknown
};

struct ExtensionUse {
    std::string name;
    Support support = Support::Unknown;
    bool isDeclared = false, isRequired = false;
    std::string consequence; // of an ignored one, "such materials are opaque"
};

// Every extension that the file declares, requires or holds, by name.
std::vector<ExtensionUse> extensionsOf(const JsonFindings& findings);

// Notes for the extensions that are left out, required ones among them, and for undeclared ones.
void noteExtensions(const SourceFile& source, const JsonFindings& findings);

// One note for each feature of glTF itself that the file uses and the renderer leaves out.
void noteIgnoredFeatures(const SourceFile& source, const tinygltf::Model& model);

} // namespace irradia::gltf
