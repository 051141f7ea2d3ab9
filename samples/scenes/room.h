// The shell of a room: slabs that overlap at the edges, so that no light leaks in.
#pragma once

#include "primitives.h"

namespace irradia::scenes {

constexpr float kWallThickness = 0.2f;

// The inside of a room.
struct Room {
    glm::vec3 lower;
    glm::vec3 upper;

    // Slabs around the inside; walls reach into floor and ceiling, and x walls into z walls.
    Mesh floor() const;
    Mesh ceiling() const;
    Mesh wallNegativeX() const;
    Mesh wallPositiveX() const;
    Mesh wallNegativeZ() const;
    Mesh wallPositiveZ() const;

    // The wall at lower.x with a hole; the opening in (z, y).
    Mesh wallNegativeXWithOpening(Rectangle opening) const;
};

} // namespace irradia::scenes
