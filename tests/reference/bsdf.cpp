#include "tests/reference/bsdf.h"
#include "tests/reference/energy_mend.h"
#include <algorithm>

namespace irradia::reference {

namespace {

Vec3 schlick(const Vec3& f0, double fc) {
    return f0 + (1.0 - f0) * fc;
}

} // namespace

Bsdf::Bsdf(const BsdfParameters& parameters)
    : p_(parameters)
    , ggx_{std::max(parameters.roughness * parameters.roughness, kMinAlpha)}
    , isPureDiffuse_(parameters.metallic == 0.0 && parameters.specular == 0.0) {}

double Bsdf::mend(double mu) const {
    if (p_.specular == 0.0) return 1.0;
    const EnergyTable& table = EnergyTable::instance();
    return mendFactor(p_.specular, maxComponent(p_.f0), table.specular(mu, ggx_.alpha), table.diffuse(mu));
}

Vec3 Bsdf::evaluate(const Vec3& v, const Vec3& l, Lobes lobes) const {
    if (v.z <= 0.0 || l.z <= 0.0) return Vec3(0.0);
    const double fc = schlickWeight(glm::dot(v, glm::normalize(v + l)));
    const Vec3 dielectric = p_.specular * schlick(p_.f0, fc), metal = schlick(p_.baseColor, fc);
    const bool all = lobes == Lobes::All;
    const bool hasDiffuse = p_.metallic < 1.0 && (all || lobes == Lobes::Diffuse);

    Vec3 f(0.0);
    if (hasDiffuse) {
        const double shared = std::min(mend(v.z), mend(l.z));
        f += (1.0 - p_.metallic) * (1.0 - maxComponent(dielectric)) * shared / kPi * p_.baseColor;
    }
    if (!isPureDiffuse_ && lobes != Lobes::Diffuse) {
        const double spec = ggx_.specular(v, l);
        if (all || lobes == Lobes::DielectricSpecular) f += (1.0 - p_.metallic) * spec * dielectric;
        if (all || lobes == Lobes::MetalSpecular) f += p_.metallic * spec * metal;
    }
    return f;
}

// By the lobes' rough reflectances towards V, never below a tenth where both lobes exist: any choice is
// unbiased.
double Bsdf::specularProbability(double cosV) const {
    if (isPureDiffuse_) return 0.0;
    if (p_.metallic >= 1.0) return 1.0;
    const double fc = schlickWeight(cosV);
    const double dielectric = p_.specular * luminance(schlick(p_.f0, fc));
    const double diffuse = (1.0 - p_.metallic) * (1.0 - dielectric) * luminance(p_.baseColor);
    const double reflection =
        (1.0 - p_.metallic) * dielectric + p_.metallic * luminance(schlick(p_.baseColor, fc));
    return std::clamp(reflection / std::max(reflection + diffuse, 1e-12), 0.1, 0.9);
}

double Bsdf::pdf(const Vec3& v, const Vec3& l) const {
    if (v.z <= 0.0 || l.z <= 0.0) return 0.0;
    const double specular = specularProbability(v.z);
    const double reflected = specular > 0.0 ? ggx_.reflectedPdf(v, l) : 0.0;
    return (1.0 - specular) * l.z / kPi + specular * reflected;
}

BsdfSample Bsdf::sample(const Vec3& v, double uLobe, const Vec2& u) const {
    BsdfSample sample;
    if (uLobe < specularProbability(v.z))
        sample.direction = reflect(v, ggx_.sampleVisibleNormal(v, u));
    else
        sample.direction = direction(std::sqrt(1.0 - u.y), 2.0 * kPi * u.x);
    sample.pdf = pdf(v, sample.direction);
    if (sample.pdf > 0.0) sample.weight = evaluate(v, sample.direction) * sample.direction.z / sample.pdf;
    return sample;
}

namespace {

// Integral over L of (1 - max Fd) min(s(V), s(L)) N.L / pi; nu = N.L. The integrand bends at nu = mu.
double mendedDiffuseAlbedo(double specular, double f0Max, double alpha, double mu) {
    static const QuadratureRule rule = gaussLegendre(16);
    const EnergyTable& table = EnergyTable::instance();
    const auto mend = [&](double nu) {
        return mendFactor(specular, f0Max, table.specular(nu, alpha), table.diffuse(nu));
    };
    const double mendV = mend(mu);
    const auto integrand = [&](double nu) {
        const double fc = azimuthalSchlick(mu, nu, 32);
        return 2.0 * nu * (1.0 - specular * (f0Max + (1.0 - f0Max) * fc)) * std::min(mendV, mend(nu));
    };
    double sum = 0.0, upper = mu;
    for (int panel = 0; panel < 12; ++panel, upper *= 0.5) // [2^-12 mu, mu], dyadic towards the horizon
        sum += rule.integrate(0.5 * upper, upper, integrand);
    const int above = 6;
    for (int panel = 0; panel < above; ++panel)
        sum +=
            rule.integrate(mu + (1.0 - mu) * panel / above, mu + (1.0 - mu) * (panel + 1) / above, integrand);
    return sum;
}

} // namespace

Vec3 directionalAlbedo(const BsdfParameters& p, double mu, Lobes lobes) {
    const double alpha = Bsdf(p).alpha();
    const bool all = lobes == Lobes::All;
    Vec3 albedo(0.0);
    if (all || lobes == Lobes::Diffuse) {
        const double mended =
            p.specular > 0.0 ? mendedDiffuseAlbedo(p.specular, maxComponent(p.f0), alpha, mu) : 1.0;
        albedo += (1.0 - p.metallic) * mended * p.baseColor;
    }
    if (lobes == Lobes::Diffuse) return albedo;
    const SpecularIntegrals integrals = integrateSpecular(mu, alpha);
    if (all || lobes == Lobes::DielectricSpecular)
        albedo += (1.0 - p.metallic) * p.specular * (p.f0 * integrals.a + integrals.b);
    if (all || lobes == Lobes::MetalSpecular)
        albedo += p.metallic * (p.baseColor * integrals.a + integrals.b);
    return albedo;
}

} // namespace irradia::reference
