// Every fault of a glTF scene at once, where loading tells the first.
#pragma once

#include "engine/scene/finding.h"
#include <filesystem>
#include <vector>

namespace irradia {

// In the order of the checks: the text, then data, textures, materials, meshes, cameras, skins, lights,
// nodes and scenes, then what is read through them. Where the text itself is at fault nothing beyond it is
// checked, and one thing tells one fault. Without an error among them the scene loads. Throws Error:
// NotFound, Io.
std::vector<Finding> validateScene(const std::filesystem::path& file);

} // namespace irradia
