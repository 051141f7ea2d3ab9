// EXT_meshopt_compression through meshoptimizer.
#pragma once

#include "engine/scene/gltf/decompress.h"

namespace irradia::gltf {

// Each compressed buffer view becomes a plain one of a buffer of its own.
void decodeMeshopt(const SourceFile& source, tinygltf::Model& model, DecodedData& decoded);

} // namespace irradia::gltf
