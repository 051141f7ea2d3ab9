#include "room.h"

namespace irradia::scenes {

namespace {

constexpr float kOverlap = 0.5f * kWallThickness;

} // namespace

Mesh Room::floor() const {
    return box({lower.x - kWallThickness, lower.y - kWallThickness, lower.z - kWallThickness},
               {upper.x + kWallThickness, lower.y, upper.z + kWallThickness});
}

Mesh Room::ceiling() const {
    return box({lower.x - kWallThickness, upper.y, lower.z - kWallThickness},
               {upper.x + kWallThickness, upper.y + kWallThickness, upper.z + kWallThickness});
}

Mesh Room::wallNegativeX() const {
    return box({lower.x - kWallThickness, lower.y - kOverlap, lower.z - kOverlap},
               {lower.x, upper.y + kOverlap, upper.z + kOverlap});
}

Mesh Room::wallPositiveX() const {
    return box({upper.x, lower.y - kOverlap, lower.z - kOverlap},
               {upper.x + kWallThickness, upper.y + kOverlap, upper.z + kOverlap});
}

Mesh Room::wallNegativeZ() const {
    return box({lower.x - kOverlap, lower.y - kOverlap, lower.z - kWallThickness},
               {upper.x + kOverlap, upper.y + kOverlap, lower.z});
}

Mesh Room::wallPositiveZ() const {
    return box({lower.x - kOverlap, lower.y - kOverlap, upper.z},
               {upper.x + kOverlap, upper.y + kOverlap, upper.z + kWallThickness});
}

Mesh Room::wallNegativeXWithOpening(Rectangle opening) const {
    // The wall's own x axis becomes -z, so its front looks along +x.
    const Rectangle wall{{-upper.z - kOverlap, lower.y - kOverlap},
                         {-lower.z + kOverlap, upper.y + kOverlap}};
    const Rectangle hole{{-opening.upper.x, opening.lower.y}, {-opening.lower.x, opening.upper.y}};
    const glm::mat4 turned = translation({lower.x, 0.0f, 0.0f}) * rotationY(90.0f);
    Mesh mesh;
    mesh.append(wallWithOpening(wall, hole, kWallThickness), turned);
    return mesh;
}

} // namespace irradia::scenes
