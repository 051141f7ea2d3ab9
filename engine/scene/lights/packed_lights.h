// The lights of a scene: local ones, which are emissive triangles, points and spots, as an alias table by
// power or as a hierarchy; directional ones and the environment's texels as alias tables by what they send.
#pragma once

#include "engine/scene/packed_scene.h"

namespace irradia {

// Per material: mean luminance that one side emits, times the number of sides that do.
std::vector<double> emissiveLuminances(const Scene& scene);

// From this many local lights on, a hierarchy chooses among them: of fewer (the two of a lamp that is a
// rectangle) it lowers the error by nothing, at up to 15 % of a frame.
inline constexpr uint32_t kLightTreeFrom = 8;

struct PackedLights {
    std::vector<glm::uvec4>
        quads; // one per local light, the hierarchy's nodes if there is one, punctual lights
    std::vector<uint32_t> lightOf; // per triangle: its light, gpu::kNoLight where its material does not emit
    uint32_t count = 0;            // local lights, triangles first
    uint32_t emitters = 0;         // triangles among them
    uint32_t directional = 0;
    uint32_t firstPunctual = 0; // quad
};

// Every triangle whose material is among the emitters is a light. Power = area x mean luminance of the
// emission (of the whole emissive texture) x sides; a light without power is never chosen while another has
// some. Size and order of the quads depend on the emitters and the punctual lights alone.
PackedLights packLights(const Scene& scene, const std::vector<bool>& emitters);

// Groups of lights that give some have equal shares.
LightShares lightShares(const Scene& scene, const SceneNeeds& needs);

// Texels and alias table. A constant becomes a small picture, so that sampling stays by solid angle. Weights
// are the integrals of the bilinear radiance's luminance over each texel, times its solid angle. A picture of
// more than maxTexels is reduced, with a warning.
void packEnvironment(const Environment& environment, PackedScene& out,
                     uint64_t maxTexels = kMaxBindingBytes / sizeof(glm::uvec4));

} // namespace irradia
