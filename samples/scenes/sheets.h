// Surfaces p(u, v), 0..1 each, facing cross(dp/du, dp/dv); uv has v downwards.
#pragma once

#include "mesh.h"

#include <functional>

namespace irradia::scenes {

using Surface = std::function<glm::vec3(float, float)>;

// Cloth, leaves: a closed solid of the given thickness; 4 nu nv + 4 (nu + nv) triangles.
Mesh sheet(const Surface& surface, uint32_t nu, uint32_t nv, float thickness);

// Without a thickness, open, for materials with two sides; 2 nu nv triangles.
Mesh openSheet(const Surface& surface, uint32_t nu, uint32_t nv);

} // namespace irradia::scenes
