// Lights without extent (KHR_lights_punctual): points, spots and directional ones. They are met by chance
// never, only by a ray towards them.
#pragma once

#include "engine/scene/scene.h"
#include "tests/reference/math.h"

namespace irradia::reference {

struct PunctualSample {
    Vec3 direction{0.0};   // unit, from the receiver
    double distance = 0.0; // 1e300 = a directional light
    Vec3 irradiance{0.0};  // of a receiver that faces it, unoccluded
    double chance = 0.0;   // with which this light was chosen; 0 = no sample
};

// What one light sends to a receiver, with chance 1.
PunctualSample illuminate(const PunctualLight& light, const Vec3& receiver);

// A light chosen by the luminance it sends to the receiver; u in [0, 1).
PunctualSample samplePunctual(const std::vector<PunctualLight>& lights, const Vec3& receiver, double u);

} // namespace irradia::reference
