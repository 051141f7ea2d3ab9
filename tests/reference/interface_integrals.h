// Directional albedos of a rough interface between two media, by deterministic quadrature over microfacet
// normals H: for V at cosine mu,
//   reflected   = integral of F G2(V, R) (V.H) D(H) / N.V over the H that reflect above the horizon,
//   transmitted = integral of (1 - max F) G2(V, T) (V.H) D(H) / N.V over those that refract below it,
// T being weighted by n_l^2 / n_v^2, the share of light rather than of radiance (Walter et al. 2007).
#pragma once

#include "tests/reference/fresnel.h"

namespace irradia::reference {

struct InterfaceAlbedo {
    Vec3 reflected{0.0};
    double transmitted = 0.0;
};

// mu in [0, 1], alpha in [1e-3, 1]; order = nodes of a panel. The default is within 1e-6 of twice the order
// (reference_glass_energy_test shows it): about 0.1 ms.
InterfaceAlbedo integrateInterface(double mu, double alpha, const DielectricFresnel& fresnel, int order = 12);

} // namespace irradia::reference
