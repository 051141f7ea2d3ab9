// Scenes written in code for tests with a known answer.
#pragma once

#include "engine/scene/scene.h"

namespace irradia::reference {

// Lambert alone: no dielectric reflection, not metallic.
Material lambert(const glm::vec3& albedo, const glm::vec3& emission = glm::vec3(0.0f));

// Adds a material and returns its index.
uint32_t addMaterial(Scene& scene, const Material& material);

// Parallelogram corner, corner + a, corner + a + b, corner + b with its front towards cross(a, b), uv (0, 0)
// to (1, 1) along a and b, tangent along a.
void addQuad(Scene& scene, uint32_t material, const glm::vec3& corner, const glm::vec3& a,
             const glm::vec3& b);

// Sphere of flat triangles, closed, with its front inside.
void addSphereFromInside(Scene& scene, uint32_t material, const glm::vec3& centre, float radius, int rings);

// Square box open towards the viewer at +z, lamp under the ceiling, red and green side walls, two blocks:
// Lambert but for a block of rough metal and a smooth dielectric floor. Size 2, centred on the origin; camera
// included.
Scene smallBox();

Camera lookAt(const glm::vec3& position, const glm::vec3& target, float verticalFov);

} // namespace irradia::reference
