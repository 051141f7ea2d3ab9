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

// Whitewashed bricks in running bond, 8 courses of 4 a picture.
Rgba8Image bricks(int size, glm::vec3 wash, glm::vec3 clay);

// A leaf, stalk at v = 1 and tip at v = 0, with its veins; alpha is its outline. Covers 0..1 once.
Rgba8Image toothedLeaf(int size, glm::vec3 blade, glm::vec3 vein);
// One that is slit between its side veins, and holed beside the middle one.
Rgba8Image slitLeaf(int size, glm::vec3 blade, glm::vec3 vein);

// Woven bands; alpha is 0.9 in them and 0.4 between.
Rgba8Image net(int size, glm::vec3 color);

// An abstract landscape for a picture frame; covers 0..1 once.
Rgba8Image landscape(int width, int height);

} // namespace irradia::scenes
