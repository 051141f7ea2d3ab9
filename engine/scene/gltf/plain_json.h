// Files as tinygltf can read them: it refuses primitives whose indices are compressed, and buffers that stand
// for data which is only there compressed.
#pragma once

#include "engine/scene/gltf/json_guard.h"
#include "engine/scene/gltf/model.h"

namespace irradia::gltf {

inline constexpr const char* kDraco = "KHR_draco_mesh_compression";
inline constexpr const char* kMeshopt = "EXT_meshopt_compression";

// The bytes of the file, .gltf or .glb as it is, changed so; none where nothing needs a change. The JSON has
// passed guardJson.
std::vector<uint8_t> plainBytes(const SourceFile& source, const JsonFindings& findings);

// Puts back what plainBytes took from the primitives.
void restorePrimitives(tinygltf::Model& model);

} // namespace irradia::gltf
