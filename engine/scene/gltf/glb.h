// The container .glb: a header and chunks around JSON and one buffer.
#pragma once

#include "engine/scene/gltf/file.h"
#include <string_view>

namespace irradia::gltf {

// Told by the file's magic.
bool isBinary(const SourceFile& source);

// The JSON text of a .gltf, or of a .glb whose chunks are checked against the file's size.
std::string_view jsonText(const SourceFile& source);

// The same file with another JSON text.
std::vector<uint8_t> withJson(const SourceFile& source, std::string json);

} // namespace irradia::gltf
