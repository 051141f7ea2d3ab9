// The colour spaces in which FLIP compares (Andersson et al. 2020, section 4).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace irradia {

// The sRGB curve undone, of an 8-bit code.
double toLinear(uint8_t encoded);

// The opponent space of the contrast sensitivity functions: CIELAB's axes without its cube root.
glm::dvec3 toYCxCz(const glm::dvec3& linear);
glm::dvec3 fromYCxCz(const glm::dvec3& c);

// CIELAB with chroma scaled by lightness: the Hunt effect.
glm::dvec3 toHuntLab(const glm::dvec3& linear);

// HyAB distance (Abasi, Amani Tehran, Fairchild 2020): city block in lightness, Euclidean in chroma.
double hyab(const glm::dvec3& a, const glm::dvec3& b);

} // namespace irradia
