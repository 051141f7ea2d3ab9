// Lights without extent (KHR_lights_punctual) as records of shaders/shared/scene.h, and as lights of the
// hierarchy. Those that give no light are left out.
#pragma once

#include "engine/scene/lights/light_tree.h"
#include "engine/scene/scene.h"
#include "shared/scene.h"
#include <vector>

namespace irradia {

// Which kinds of them a scene has: mask of gpu::kPunctualLocal, ...
uint32_t punctualKinds(const Scene& scene);

// The scene's points and spots. Their power is the luminance of their intensity: at importance a patch that
// gives a facing receiver the same irradiance has the same, as area x radiance / distance^2 is its importance
// too.
std::vector<const PunctualLight*> localPunctualLights(const Scene& scene);
TreeLight treeLight(const PunctualLight& light);

struct PackedPunctualLights {
    std::vector<glm::uvec4> quads; // directional lights, then points and spots
    uint32_t directional = 0;      // how many of those
};
PackedPunctualLights packPunctualLights(const Scene& scene);

} // namespace irradia
