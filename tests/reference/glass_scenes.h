// Small scenes of glass, screens and lamps, each with its camera: closed rooms of size 2 around the origin
// with a wide lamp under the ceiling, so that a picture of some 40x40 pixels is quiet after few samples.
#pragma once

#include "engine/scene/scene.h"

namespace irradia::reference {

// Clear glass, white: transmits all, closed surfaces of it have an inside.
Material solidGlass(float ior, float roughness);
// The same as a sheet.
Material glassSheet(float roughness);

// A closed sphere with its front outside; `isSmooth`: normals of the sphere rather than of its triangles.
void addSphere(Scene& scene, uint32_t material, const glm::vec3& centre, float radius, int rings,
               bool isSmooth);
// A closed box with its fronts outside.
void addCuboid(Scene& scene, uint32_t material, const glm::vec3& lower, const glm::vec3& upper);

// A ball of smooth glass, of flat triangles or with the normals of a sphere.
Scene glassBall(bool isSmooth);
// A slab of rough, coloured and absorbing glass before the back of the room.
Scene roughSlab();
// A clear ball with a coloured, absorbing one of another index in it.
Scene nestedBalls();
// Screens: one blended and one masked, both by a small picture; clear and rough sheets, a surface without
// light and shade, vertices' colours, a picture turned by its transform.
Scene screens();
// A room without a ceiling or a lamp of an extent, lit by a point, a spot and a directional light, with a
// rough and a smooth block.
Scene punctualRoom();

} // namespace irradia::reference
