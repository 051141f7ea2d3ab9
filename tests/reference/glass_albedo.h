// The directional albedo of a glass BSDF by deterministic quadrature.
#pragma once

#include "tests/reference/glass.h"

namespace irradia::reference {

// Shares of the light from V that end on V's side and on the other; a share of light, not of radiance: what
// is transmitted is weighted by Glass::etendue().
struct GlassAlbedo {
    Vec3 reflected{0.0};
    Vec3 transmitted{0.0};
};

// Of all lobes, V at cosine mu; to about 1e-4 where there is a Lambert lobe, else 1e-5.
GlassAlbedo directionalAlbedo(const Glass& glass, double mu);

} // namespace irradia::reference
