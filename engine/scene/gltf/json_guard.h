// The checks made on the JSON text before tinygltf sees it. tinygltf builds trees by recursion, cuts integers
// to 32 bits and takes a property of the wrong type for an absent one; none of that can happen behind this
// guard.
#pragma once

#include "engine/scene/gltf/file.h"
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace irradia::gltf {

// A buffer in a file beside the scene, as the JSON states it.
struct BufferClaim {
    std::string uri;
    uint64_t byteLength = 0;
};

// What is needed before parsing.
struct JsonFindings {
    std::vector<BufferClaim> buffers;         // in the file's order
    std::set<std::string> extensionsDeclared; // in extensionsUsed
    std::set<std::string> extensionsRequired;
    std::set<std::string> extensionsFound; // where an object holds its "extensions"
};

enum class Schema { Gltf, Any }; // Any: only the shape of the text counts

// Throws BadData for broken JSON, too deep nesting, too many values, and glTF's integers that are none or too
// large.
JsonFindings guardJson(const SourceFile& source, std::string_view json, Schema schema = Schema::Gltf);

} // namespace irradia::gltf
