// Small scenes that give light.
#pragma once

#include "engine/scene/scene.h"

namespace irradia::test {

// A picture of sky and a strong sun, width x height texels.
Environment skyWithSun(int width, int height);

// Triangles around the origin, of many sizes and powers, some of both sides. Light i's blue is i + 1.
Scene manyEmitters(int count);

// Points, spots and directional lights around the origin, of many intensities; one in seven gives no light.
void addPunctualLights(Scene& scene, int points, int spots, int directional);

} // namespace irradia::test
