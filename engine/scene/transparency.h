// What of a scene lets light through: straight on (alpha, clear sheets), or by scattering it (glass).
#pragma once

#include "engine/scene/scene.h"

namespace irradia {

bool isSheet(const Material& material); // transmits, and has no inside
bool isSolid(const Material& material); // transmits into its inside
bool scattersTransmitted(const Material& material);

// Whether some light may go straight on through a triangle: what its pictures have in fact there is known
// when a ray meets it.
bool mayLetThrough(const Scene& scene, const Triangle& triangle);

// Whether some does through any, or some surface has an inside.
bool letsLightThrough(const Scene& scene);

} // namespace irradia
