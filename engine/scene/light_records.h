// The lights of a scene as alias tables: emissive triangles by power, environment texels by radiance and
// solid angle.
#pragma once

#include "engine/scene/scene_records.h"

namespace irradia {

// Appends one record per emissive triangle; returns the light index of every triangle, gpu::kNoLight for the
// others. Power = area x mean luminance of the emission (of the whole emissive texture) x sides.
std::vector<uint32_t> packLights(const Scene& scene, std::vector<glm::uvec4>& lights);

// Texels and alias table. A constant becomes a small picture, so that sampling stays by solid angle. Weights
// are the integrals of the bilinear radiance's luminance over each texel, times its solid angle.
void packEnvironment(const Environment& environment, SceneRecords& out);

} // namespace irradia
