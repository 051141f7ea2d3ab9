// Telling where in the JSON it lies that the parser refused: it ends at its first fault, by a sentence alone.
#pragma once

#include "engine/scene/gltf/file.h"

namespace irradia::gltf {

// Reports each missing property, each value that is not in its list, and what is no array or no object. The
// JSON has passed guardJson.
void reportSchemaFaults(const SourceFile& source);

} // namespace irradia::gltf
