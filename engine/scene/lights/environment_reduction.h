// Environments larger than a binding.
#pragma once

#include "engine/scene/scene.h"

namespace irradia {

// Halves the picture (box filter) until it has no more than maxTexels.
void reduceToFit(Environment& environment, uint64_t maxTexels);

} // namespace irradia
