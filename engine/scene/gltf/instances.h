// Placing primitives in the world: transforms, winding, unit normals, and the triangles that must not get
// further.
#pragma once

#include "engine/scene/gltf/primitives.h"
#include <glm/glm.hpp>

namespace irradia::gltf {

// Appends a copy of the primitive to the scene. Triangles with corners that are not finite, or with no area
// (relative to their longest edge squared), are left out and counted in the scene's notes.
void appendInstance(const PrimitiveMesh& mesh, const glm::dmat4& toWorld, Scene& scene);

} // namespace irradia::gltf
