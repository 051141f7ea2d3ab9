// The lights of a scene as alias tables: emissive triangles by power, environment texels by radiance and
// solid angle.
#pragma once

#include "engine/scene/scene_records.h"

namespace irradia {

// Per material: mean luminance that one side emits, times the number of sides that do.
std::vector<double> emissiveLuminances(const Scene& scene);

// Appends one record per triangle whose material is among the emitters; returns the light index of every
// triangle, gpu::kNoLight for the others. Power = area x mean luminance of the emission (of the whole
// emissive texture) x sides; a light without power has a record, and is never chosen while another has some.
std::vector<uint32_t> packLights(const Scene& scene, const std::vector<bool>& emitters,
                                 std::vector<glm::uvec4>& lights);

// Of a light sample going to the environment: a half where triangles emit too.
float environmentProbability(const Scene& scene, const SceneNeeds& needs);

// Texels and alias table. A constant becomes a small picture, so that sampling stays by solid angle. Weights
// are the integrals of the bilinear radiance's luminance over each texel, times its solid angle.
void packEnvironment(const Environment& environment, SceneRecords& out);

} // namespace irradia
