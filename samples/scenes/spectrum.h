// Spectra to linear Rec. 709.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace irradia::scenes {

// The colour of a spectrum sampled at `stepNm` from 400 nm on (linear in between), relative to the
// equal-energy spectrum of value 1, which gives (1, 1, 1). So a reflectance of r at all wavelengths is the
// albedo r, and light keeps its scale.
glm::vec3 linearRec709(std::span<const float> spectrum, float stepNm);

} // namespace irradia::scenes
