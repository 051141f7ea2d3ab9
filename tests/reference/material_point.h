// A triangle's material at a point: vertex attributes between the corners, and what the textures make of the
// material's factors.
#pragma once

#include "engine/scene/scene.h"
#include "tests/reference/bsdf.h"
#include "tests/reference/texture.h"

namespace irradia::reference {

// Vertex attributes at barycentric coordinates (1 - u - v, u, v).
struct Interpolated {
    Vec3 normal;
    glm::dvec4 tangent;
    Vec2 uv[2];
    glm::dvec4 color;
};

Interpolated interpolate(const Scene& scene, const Triangle& triangle, const Vec2& uv);

glm::dvec4 lookUp(const Scene& scene, const TextureRef& texture, const Interpolated& at, Encoding encoding);

// f0 is that of the material against an index of 1.
BsdfParameters bsdfParameters(const Scene& scene, const Material& material, const Interpolated& at);

double transmissionAt(const Scene& scene, const Material& material, const Interpolated& at); // tau

// The share of a point that is there, by the material's alpha mode.
double coverageAt(const Scene& scene, const Material& material, const Interpolated& at);

// Radiance of the emitting side at full coverage.
Vec3 emissionAt(const Scene& scene, const Material& material, const Interpolated& at);

} // namespace irradia::reference
