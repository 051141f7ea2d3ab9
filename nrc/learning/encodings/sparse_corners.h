// Which corners of a level a sparse grid stores (NGLOD, Takikawa et al. 2021, section 3.2).
#pragma once

#include "shared/network.h"
#include <span>
#include <vector>

namespace irradia {

// The corners of the voxels that hold a point, as indices x + stride (y + stride z), rising. Points outside
// the unit cube count at its border. Throws Error(BadData) naming a point that is not finite.
std::vector<uint32_t> touchedCorners(const gpu::GridLevel& level, uint32_t dims,
                                     std::span<const glm::vec3> points);

} // namespace irradia
