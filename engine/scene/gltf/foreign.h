// Telling what a file is that was given as a scene and is no glTF, by its first bytes.
#pragma once

#include "engine/scene/gltf/file.h"

namespace irradia::gltf {

// "a gzip archive", by a file's first bytes; empty where they are of no format that is known here.
std::string_view foreignFormat(std::string_view bytes);

// Throws BadData naming the format of a file that is known to be another one.
void refuseForeignFormat(const SourceFile& source);

} // namespace irradia::gltf
