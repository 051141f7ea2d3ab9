// The energy mend of the project's dielectric: the three integrals it is made of, by deterministic
// quadrature, and a table of them. With spec = D G2 / (4 N.V N.L), Fc = (1 - |V.H|)^5 and V at cosine mu,
// over the hemisphere of L:
//   A = integral of (1 - Fc) spec N.L,   B = integral of Fc spec N.L,   C = integral of Fc N.L / pi.
#pragma once

#include "tests/reference/quadrature.h"
#include <array>

namespace irradia::reference {

struct SpecularIntegrals {
    double a = 0.0;
    double b = 0.0;
};

// Order of the quadrature; the defaults are within 1e-7 of twice the order (reference_test shows it).
struct IntegralOrder {
    int azimuth = 24;
    int polar = 40; // nodes in each of the two ranges of the normal's polar angle
};

// A and B, mu in [0, 1], alpha in [1e-3, 1]: about 0.1 ms.
SpecularIntegrals integrateSpecular(double mu, double alpha, IntegralOrder order = {});
// Mean of Fc over the azimuth between V at cosine mu and L at cosine nu.
double azimuthalSchlick(double mu, double nu, int order = 64);
// C, mu in [0, 1].
double integrateDiffuse(double mu);

// s = min(1, (1 - E_spec) / E_diffuse), 0 where E_diffuse <= 0. `specular` is the factor of
// KHR_materials_specular, f0Max the largest component of F0.
double mendFactor(double specular, double f0Max, SpecularIntegrals integrals, double c);

// A, B and C on a grid, between the nodes by cubic Lagrange interpolation; error < 1e-5 (reference_test shows
// it).
class EnergyTable {
public:
    // Built on first use, by all threads of the machine; about half a second.
    static const EnergyTable& instance();

    SpecularIntegrals specular(double mu, double alpha) const; // alpha in [1e-3, 1]
    double diffuse(double mu) const;

private:
    EnergyTable();
    static constexpr int kAlphas = 80;
    static constexpr int kCosines = 128;
    static constexpr int kDiffuse = 256; // uniform in sqrt(mu)
    std::array<std::array<SpecularIntegrals, kCosines>, kAlphas> specular_{};
    std::array<double, kDiffuse> diffuse_{};
};

} // namespace irradia::reference
