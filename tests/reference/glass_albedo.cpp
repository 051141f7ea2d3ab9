#include "tests/reference/glass_albedo.h"
#include "tests/reference/energy_mend.h"
#include "tests/reference/interface_integrals.h"

namespace irradia::reference {

namespace {

constexpr int kNodes = 16;

// Over [from, to], nodes gathered at both ends.
template <typename Function>
double integrateGathered(double from, double to, const Function& f) {
    static const QuadratureRule rule = gaussLegendre(kNodes);
    return rule.integrate(0.0, 1.0, [&](double t) {
        const double x = t * t * (3.0 - 2.0 * t);
        return 6.0 * t * (1.0 - t) * (to - from) * f(from + (to - from) * x);
    });
}

// Mean over the azimuth between V and L of 1 - max F, which bends at the critical angle of the half vector.
double meanThrough(const DielectricFresnel& fresnel, double mu, double nu) {
    const double inPlane = mu * nu, across = std::sqrt((1.0 - mu * mu) * (1.0 - nu * nu));
    const auto through = [&](double azimuth) {
        const double cosVL = inPlane + across * std::cos(azimuth);
        return 1.0 - maxComponent(fresnel(std::sqrt(std::fmax(0.0, 0.5 * (1.0 + cosVL)))));
    };
    double split = 0.5 * kPi;
    if (fresnel.eta < 1.0 && across > 0.0) {
        const double cosCritical = 2.0 * (1.0 - fresnel.eta * fresnel.eta) - 1.0; // of the angle from V to L
        split = std::acos(std::clamp((cosCritical - inPlane) / across, -1.0, 1.0));
    }
    return (integrateGathered(0.0, split, through) + integrateGathered(split, kPi, through)) / kPi;
}

// Of the Lambert lobe of a white surface.
double lambertAlbedo(const Glass& glass, const DielectricFresnel& fresnel, double mu) {
    std::vector<double> points = {0.0, mu, 0.5 * (1.0 + mu), 1.0};
    for (double below = 0.5 * mu; below > 1e-4; below *= 0.5) points.push_back(below);
    if (fresnel.eta < 1.0) points.push_back(std::sqrt(1.0 - fresnel.eta * fresnel.eta));
    std::sort(points.begin(), points.end());
    const double mendV = glass.mend(mu);
    double sum = 0.0;
    for (size_t i = 1; i < points.size(); ++i)
        sum += integrateGathered(points[i - 1], points[i], [&](double nu) {
            return 2.0 * nu * std::min(mendV, glass.mend(nu)) * meanThrough(fresnel, mu, nu);
        });
    return sum;
}

} // namespace

GlassAlbedo directionalAlbedo(const Glass& glass, double mu) {
    const BsdfParameters& p = glass.surface();
    const GlassParameters& g = glass.glass();
    const double alpha = glass.alpha(), dielectric = 1.0 - p.metallic, tau = g.transmission;
    const bool isSolid = g.kind == GlassParameters::Kind::Solid;
    const bool isClear = g.kind == GlassParameters::Kind::ClearSheet;
    const DielectricFresnel fresnel{p.f0, p.specular, isSolid ? g.eta : 1.0};
    const SpecularIntegrals specular = integrateSpecular(mu, alpha);

    InterfaceAlbedo single;
    if (isSolid) {
        single = integrateInterface(mu, alpha, fresnel);
    } else {
        single.reflected = p.specular * (p.f0 * specular.a + specular.b);
        single.transmitted = specular.a + specular.b - maxComponent(single.reflected);
    }
    GlassAlbedo albedo;
    albedo.reflected = dielectric * single.reflected + p.metallic * (p.baseColor * specular.a + specular.b);
    if (tau < 1.0)
        albedo.reflected += dielectric * (1.0 - tau) * lambertAlbedo(glass, fresnel, mu) * p.baseColor;
    if (isClear) return albedo;
    albedo.transmitted = dielectric * tau * single.transmitted * p.baseColor;
    if (alpha <= kMinAlpha) return albedo;
    const GlassEnergy& here = isSolid ? GlassEnergy::ofInterface(g.eta) : GlassEnergy::ofSheet();
    const GlassEnergy& there = isSolid ? GlassEnergy::ofInterface(1.0 / g.eta) : here;
    const double lostHere = 1.0 - here.average(alpha);
    const double lostThere = (isSolid ? g.eta * g.eta : 1.0) * (1.0 - there.average(alpha));
    const double many =
        glass.returnedShare() * dielectric * tau * (1.0 - here.albedo(mu, alpha)) / (lostHere + lostThere);
    albedo.reflected += many * lostHere;
    albedo.transmitted += many * lostThere * p.baseColor;
    return albedo;
}

} // namespace irradia::reference
