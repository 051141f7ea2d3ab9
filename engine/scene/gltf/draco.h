// KHR_draco_mesh_compression through Draco.
#pragma once

#include "engine/scene/gltf/decompress.h"

namespace irradia::gltf {

// Each compressed primitive's accessors become plain ones.
void decodeDraco(const SourceFile& source, tinygltf::Model& model, DecodedData& decoded);

} // namespace irradia::gltf
