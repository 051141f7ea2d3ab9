// Plants for the greenhouse: leaves are flat pictures with an outline in alpha, bent, of two sides.
#pragma once

#include "mesh.h"
#include "random.h"

namespace irradia::scenes {

// All plants of a scene, a mesh a material; colours of vertices tell their parts apart.
struct Greenery {
    Mesh toothed, slit; // leaves
    Mesh stems;
    Mesh fruits; // and petals
};

// A bush about the origin of `place`, `height` high, with blossoms of the given colour above its leaves.
void addBush(Greenery& plants, const glm::mat4& place, float height, glm::vec3 blossom, uint32_t seed);

// Large slit leaves on long stalks.
void addSlitLeaved(Greenery& plants, const glm::mat4& place, float height, uint32_t seed);

// A stem with a round crown, in it lemons.
void addLemonTree(Greenery& plants, const glm::mat4& place, float height, uint32_t seed);

// Leaves over the rectangle width x height of the xy plane, facing +z.
void addClimber(Greenery& plants, const glm::mat4& place, glm::vec2 size, uint32_t seed);

// Strings of leaves that hang down.
void addTrailing(Greenery& plants, const glm::mat4& place, float length, uint32_t seed);

// A lemon along y, green at the stalk.
Mesh lemon();

} // namespace irradia::scenes
