#include "tests/reference/energy_mend.h"
#include "tests/reference/ggx.h"
#include "tests/reference/lagrange.h"
#include "tests/reference/parallel.h"
#include <algorithm>

namespace irradia::reference {

namespace {

// The integrals over L, written over the microfacet normal H (dL = 4 V.H dH): with tan(polar of H) = alpha
// sinh(y),
//   integral of X spec N.L dL = integral of X D G2 V.H / N.V dH,   D dH = sinh(y) / (pi cosh(y)^3 cos(polar))
//   dy dphi.
// L is above the horizon exactly for azimuths of H (from V's) below a bound that is explicit in the polar
// angle.
class NormalIntegral {
public:
    NormalIntegral(double mu, double alpha, IntegralOrder order)
        : ggx_{alpha}
        , mu_(mu)
        , sinV_(std::sqrt(1.0 - mu * mu))
        , order_(order) {}

    // (A, B). Up to the polar angle (90 degrees - V's) / 2 every azimuth counts, beyond (90 + V's) / 2 none
    // does; the bound has square-root ends in between, which the substitution sin^2 smooths.
    glm::dvec2 integrate() const {
        const double polarV = std::acos(mu_);
        const double all = heightOf(0.25 * kPi - 0.5 * polarV), none = heightOf(0.25 * kPi + 0.5 * polarV);
        const auto& polar = keptRule(order_.polar);
        const glm::dvec2 inner = polar.integrate(0.0, all, [&](double y) { return ring(y); });
        const glm::dvec2 outer = polar.integrate(0.0, 1.0, [&](double t) {
            const double s = std::sin(0.5 * kPi * t);
            return 0.5 * kPi * std::sin(kPi * t) * ring(all + (none - all) * s * s);
        });
        return inner + (none - all) * outer;
    }

private:
    // y of a polar angle; what lies beyond tan = 1e8 alpha weighs < 1e-8, mu = 0 included.
    double heightOf(double polar) const { return std::asinh(std::fmin(std::tan(polar) / ggx_.alpha, 1e8)); }

    // Integrand in y: the integral over the azimuth (even, hence twice the half), nodes gathered at the
    // horizon.
    glm::dvec2 ring(double y) const {
        const double tangent = ggx_.alpha * std::sinh(y), cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
        const double along = mu_ * cosine, across = sinV_ * tangent * cosine;
        const double bound =
            across > 0.0 ? (0.5 * mu_ / cosine - along) / across : -1.0; // of the azimuth's cosine
        const double last = std::acos(std::clamp(bound, -1.0, 1.0));
        const glm::dvec2 sum = keptRule(order_.azimuth).integrate(0.0, 1.0, [&](double t) {
            const double cosVH = along + across * std::cos(last * (1.0 - t * t * t));
            const double cosL = 2.0 * cosVH * cosine - mu_;
            if (cosL <= 0.0) return glm::dvec2(0.0);
            const double fc = schlickWeight(cosVH);
            const double masking = 2.0 * cosL / (cosL * ggx_.root(mu_) + mu_ * ggx_.root(cosL)); // G2 / N.V
            return 3.0 * t * t * masking * cosVH * glm::dvec2(1.0 - fc, fc);
        });
        const double cosh = std::cosh(y);
        return 2.0 * last * std::sinh(y) / (kPi * cosh * cosh * cosh * cosine) * sum;
    }

    Ggx ggx_;
    double mu_, sinV_;
    IntegralOrder order_;
};

const double kLogMinAlpha = std::log(1e-3); // the first row of the table

// Column of the table in [0, 1] and its inverse. The integrals go like mu log(mu) at 0 (cube root), bend
// where mu is about alpha (logarithm), and like (1 - mu)^5 beyond (linear).
double warpCosine(double mu, double alpha) {
    return 0.6 * std::cbrt(std::log1p(mu / alpha) / std::log1p(1.0 / alpha)) + 0.4 * mu;
}

double unwarpCosine(double column, double alpha) {
    double lower = 0.0, upper = 1.0;
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (lower + upper);
        (warpCosine(middle, alpha) < column ? lower : upper) = middle;
    }
    return upper;
}

} // namespace

SpecularIntegrals integrateSpecular(double mu, double alpha, IntegralOrder order) {
    const glm::dvec2 sum = NormalIntegral(mu, alpha, order).integrate();
    return {sum.x, sum.y};
}

double azimuthalSchlick(double mu, double nu, int order) {
    const double inPlane = mu * nu, across = std::sqrt((1.0 - mu * mu) * (1.0 - nu * nu));
    // (V.H)^2 = (1 + V.L) / 2.
    return keptRule(order).integrate(0.0, 1.0, [&](double t) {
        const double cosVL = inPlane + across * std::cos(kPi * (1.0 - t * t));
        return 2.0 * t * schlickWeight(std::sqrt(std::fmax(0.0, 0.5 * (1.0 + cosVL))));
    });
}

double integrateDiffuse(double mu) {
    // nu = x^2 gathers nodes at the horizon: 2 nu dnu = 4 x^3 dx.
    return keptRule(64).integrate(0.0, 1.0,
                                  [&](double x) { return 4.0 * x * x * x * azimuthalSchlick(mu, x * x); });
}

double mendFactor(double specular, double f0Max, SpecularIntegrals integrals, double c) {
    const double specularAlbedo = specular * (f0Max * integrals.a + integrals.b);
    const double diffuseAlbedo = 1.0 - specular * (f0Max * (1.0 - c) + c);
    return diffuseAlbedo <= 0.0 ? 0.0 : std::clamp((1.0 - specularAlbedo) / diffuseAlbedo, 0.0, 1.0);
}

EnergyTable::EnergyTable() {
    parallelFor(kAlphas, 0, [&](int i) {
        const double alpha = std::exp(kLogMinAlpha * (1.0 - i / (kAlphas - 1.0)));
        for (int j = 0; j < kCosines; ++j) {
            specular_[i][j] = integrateSpecular(unwarpCosine(j / (kCosines - 1.0), alpha), alpha);
        }
    });
    for (int i = 0; i < kDiffuse; ++i) {
        const double root = i / (kDiffuse - 1.0);
        diffuse_[i] = integrateDiffuse(root * root);
    }
}

const EnergyTable& EnergyTable::instance() {
    static const EnergyTable table;
    return table;
}

SpecularIntegrals EnergyTable::specular(double mu, double alpha) const {
    const Stencil row((1.0 - std::log(alpha) / kLogMinAlpha) * (kAlphas - 1), kAlphas);
    const Stencil column(warpCosine(mu, alpha) * (kCosines - 1), kCosines);
    SpecularIntegrals result;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            const SpecularIntegrals& node = specular_[row.first + i][column.first + j];
            const double weight = row.weight[i] * column.weight[j];
            result.a += weight * node.a;
            result.b += weight * node.b;
        }
    return result;
}

double EnergyTable::diffuse(double mu) const {
    return Stencil(std::sqrt(mu) * (kDiffuse - 1), kDiffuse)(diffuse_);
}

} // namespace irradia::reference
