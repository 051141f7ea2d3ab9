// A material's picture at a point: bilinear at texel centres, wrapped by texel, sRGB decoded before
// filtering.
#pragma once

#include "engine/scene/scene.h"
#include "tests/reference/math.h"

namespace irradia::reference {

enum class Encoding { Linear, Srgb };

// RGBA in [0, 1] at (u, v), v downwards, before the reference's transform; alpha is never sRGB. (1, 1, 1, 1)
// where the reference names no picture.
glm::dvec4 sampleTexture(const Scene& scene, const TextureRef& texture, const Vec2& uv, Encoding encoding);

// Mean colour of the whole picture; 1 where there is none.
Vec3 meanColor(const Scene& scene, const TextureRef& texture, Encoding encoding);

} // namespace irradia::reference
