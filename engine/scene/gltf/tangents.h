// Tangents for normal maps where the file has none.
#pragma once

#include "engine/scene/gltf/primitives.h"

namespace irradia::gltf {

// Twice the signed area of a triangle in texture space. glTF's v points down, so it is negative for a picture
// seen from its front and positive for a mirrored one.
float uvArea(glm::vec2 a, glm::vec2 b, glm::vec2 c);

// Tangents along the normal map's +u, averaged over each vertex' triangles by the angle they meet at
// (Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008); w such that w cross(n, t) points along -v,
// up in the picture. Zero where the coordinates span no area. A vertex must not join mirrored triangles with
// others.
void generateTangents(PrimitiveMesh& mesh, const TextureRef& normalMap);

} // namespace irradia::gltf
