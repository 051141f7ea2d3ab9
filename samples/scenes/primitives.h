// Shapes the scenes are built of. All but `quad` are closed: every edge lies in exactly two triangles
// (corners that meet have bit-equal positions), fronts outwards.
#pragma once

#include "mesh.h"

#include <span>

namespace irradia::scenes {

// A rectangle from its lower left corner, facing cross(across, up). uv 0..repeat, v = 0 at the top.
Mesh quad(glm::vec3 corner, glm::vec3 across, glm::vec3 up, glm::vec2 repeat = glm::vec2(1.0f));

// An axis-aligned box; each side has uv 0..1.
Mesh box(glm::vec3 lower, glm::vec3 upper);

// A box about the origin with rounded edges, `segments` steps in each half of a rounding; 12 (2 s + 1)^2
// triangles.
Mesh roundedBox(glm::vec3 halfSize, float radius, uint32_t segments);

// An outline (radius, height) turned about the y axis, written from bottom to top along the outside. It
// starts and ends on the axis, or is a ring whose last point equals the first. Corners of more than 40
// degrees stay sharp.
Mesh lathe(std::span<const glm::vec2> outline, uint32_t slices);

Mesh sphere(float radius, uint32_t slices, uint32_t stacks);

// A cylinder or a cone's frustum standing on y = 0.
Mesh frustum(float bottomRadius, float topRadius, float height, uint32_t slices);

// A subdivided icosahedron of radius 1 with shared vertices, facing outwards; 20 * 4^levels triangles.
Mesh icosphere(uint32_t levels);

// Eight flat triangles about the origin.
Mesh octahedron(float radius);

struct Rectangle {
    glm::vec2 lower{0.0f};
    glm::vec2 upper{0.0f};
};

// A wall in the xy plane, from z = 0 (its front, facing +z) back to z = -thickness, with a hole through it.
Mesh wallWithOpening(Rectangle wall, Rectangle opening, float thickness);

} // namespace irradia::scenes
