// Colours of other primaries as linear Rec. 709.
#pragma once

#include <ImfChromaticities.h>
#include <glm/glm.hpp>

namespace irradia {

// The map of linear R, G, B. White stays white: another white point is adapted to D65 by Bradford's matrix
// (Lindbloom, "Chromatic Adaptation"). Exactly 1 where the primaries are Rec. 709's but for rounding.
glm::mat3 matrixToRec709(const Imf::Chromaticities& from);

} // namespace irradia
