// Pictures the scenes put on their surfaces; all repeat seamlessly unless stated. Colours are given linear
// and stored as sRGB.
#pragma once

#include "engine/image/image.h"

#include <glm/glm.hpp>

namespace irradia::scenes {

// Ceramic tiles, 4 by 4 a picture: slightly different tints and roughnesses, rounded edges, dull grout.
struct TileTextures {
    Rgba8Image baseColor;
    Rgba8Image metallicRoughness; // roughness in green, metallic (0) in blue
    Rgba8Image normal;            // tangent space, green up
};
TileTextures tiles(int size, glm::vec3 light, glm::vec3 dark);

// Boards along the u axis, 8 a picture, with grain.
Rgba8Image floorBoards(int size, glm::vec3 wood);

// A woven rug with a border and rhombs; covers 0..1 once.
Rgba8Image rug(int size, glm::vec3 ground, glm::vec3 figure);

// An abstract landscape for a picture frame; covers 0..1 once.
Rgba8Image landscape(int width, int height);

} // namespace irradia::scenes
