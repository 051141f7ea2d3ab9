#include "tests/reference/glass.h"
#include "tests/reference/energy_mend.h"

namespace irradia::reference {

namespace {

Vec3 mirrored(const Vec3& l) {
    return {l.x, l.y, -l.z};
}

} // namespace

Glass::Glass(const BsdfParameters& surface, const GlassParameters& glass)
    : p_(surface)
    , g_(glass)
    , ggx_{std::max(surface.roughness * surface.roughness, kMinAlpha)}
    , fresnel_{surface.f0, surface.specular, isSolid() ? glass.eta : 1.0}
    , energyHere_(isSolid() ? &GlassEnergy::ofInterface(glass.eta) : &GlassEnergy::ofSheet())
    , energyThere_(isSolid() ? &GlassEnergy::ofInterface(1.0 / glass.eta) : energyHere_) {
    if (!scattersManyTimes()) return;
    lostHere_ = 1.0 - energyHere_->average(ggx_.alpha);
    lostThere_ = (isSolid() ? glass.eta * glass.eta : 1.0) * (1.0 - energyThere_->average(ggx_.alpha));
}

double Glass::mend(double mu) const {
    const auto cosine = cosineInThinner(mu, fresnel_.eta);
    if (!cosine) return 0.0;
    if (p_.specular == 0.0) return 1.0;
    const EnergyTable& table = EnergyTable::instance();
    return mendFactor(p_.specular, maxComponent(p_.f0), table.specular(*cosine, ggx_.alpha),
                      table.diffuse(*cosine));
}

Vec3 Glass::metal(double cosVH) const {
    return p_.baseColor + (1.0 - p_.baseColor) * schlickWeight(cosVH);
}

Vec3 Glass::lambert(const Vec3& v, const Vec3& l) const {
    const double scale = (1.0 - p_.metallic) * (1.0 - g_.transmission);
    if (l.z <= 0.0 || scale == 0.0) return Vec3(0.0);
    const double through = 1.0 - maxComponent(fresnel_(glm::dot(v, glm::normalize(v + l))));
    return scale * through * std::min(mend(v.z), mend(l.z)) / kPi * p_.baseColor;
}

Vec3 Glass::reflected(const Vec3& v, const Vec3& l) const {
    if (l.z <= 0.0) return Vec3(0.0);
    const double cosVH = glm::dot(v, glm::normalize(v + l));
    return ggx_.specular(v, l) * ((1.0 - p_.metallic) * fresnel_(cosVH) + p_.metallic * metal(cosVH));
}

Vec3 Glass::normalOf(const Vec3& v, const Vec3& l) const {
    if (!isSolid()) return glm::normalize(v + mirrored(l));
    const Vec3 h = -glm::normalize(v + g_.eta * l);
    return h.z > 0.0 ? h : -h;
}

Vec3 Glass::transmitted(const Vec3& v, const Vec3& l) const {
    if (l.z >= 0.0 || isClear()) return Vec3(0.0);
    const Vec3 h = normalOf(v, l);
    const double cosVH = glm::dot(v, h), cosLH = glm::dot(l, h);
    const Vec3 tint =
        (1.0 - p_.metallic) * g_.transmission * (1.0 - maxComponent(fresnel_(cosVH))) * p_.baseColor;
    if (!isSolid()) return ggx_.specular(v, mirrored(l)) * tint;
    if (cosVH <= 0.0 || cosLH >= 0.0) return Vec3(0.0);
    const double visibility = 2.0 / (-l.z * ggx_.root(v.z) + v.z * ggx_.root(-l.z)); // G2 / (V.z |L.z|)
    const double spread = cosVH + g_.eta * cosLH;
    return cosVH * -cosLH * ggx_.distribution(h) * visibility / (spread * spread) * tint;
}

double Glass::returnedShare() const {
    if (!isSolid()) return 1.0;
    const double indices = normalReflectance(g_.eta), f0 = std::min(maxComponent(p_.f0), 1.0);
    constexpr double kLeast = 1e-4; // F0 of indices next to each other is below it
    const double share = f0 <= indices ? (f0 + kLeast) / indices : (1.0 - f0 + kLeast) / (1.0 - indices);
    return p_.specular * std::min(share, 1.0);
}

Vec3 Glass::multiple(const Vec3& v, const Vec3& l) const {
    if (!scattersManyTimes()) return Vec3(0.0);
    const double lostV = 1.0 - energyHere_->albedo(v.z, ggx_.alpha);
    const double lostL = 1.0 - (l.z > 0.0 ? energyHere_ : energyThere_)->albedo(std::abs(l.z), ggx_.alpha);
    const double scale = returnedShare() * (1.0 - p_.metallic) * g_.transmission * lostV * lostL /
                         (kPi * (lostHere_ + lostThere_));
    return l.z > 0.0 ? Vec3(scale) : scale * p_.baseColor;
}

Vec3 Glass::evaluate(const Vec3& v, const Vec3& l, GlassLobes lobes) const {
    if (v.z <= 0.0 || l.z == 0.0) return Vec3(0.0);
    const auto has = [&](GlassLobes lobe) { return lobes == GlassLobes::All || lobes == lobe; };
    Vec3 f(0.0);
    if (has(GlassLobes::Lambert)) f += lambert(v, l);
    if (has(GlassLobes::Reflection)) f += reflected(v, l);
    if (has(GlassLobes::Transmission)) f += transmitted(v, l);
    if (has(GlassLobes::MultipleScattering)) f += multiple(v, l);
    return f;
}

// By the lobes' rough shares, those of microfacets and Lambert's never below a tenth where they exist: any
// choice is unbiased.
Glass::Chances Glass::chances(double cosV) const {
    const Vec3 f = fresnel_(cosV);
    const double dielectric = 1.0 - p_.metallic, through = (1.0 - maxComponent(f)) * luminance(p_.baseColor);
    const double tau = isClear() ? 0.0 : g_.transmission;
    Chances c{dielectric * (1.0 - g_.transmission) * through,
              dielectric * (luminance(f) + tau * through) + p_.metallic * luminance(metal(cosV)), 0.0};
    if (scattersManyTimes())
        c.multiple = returnedShare() * dielectric * tau * (1.0 - energyHere_->albedo(cosV, ggx_.alpha));
    const double sum = std::max(c.lambert + c.microfacet + c.multiple, 1e-12);
    const bool hasLambert = dielectric * (1.0 - g_.transmission) > 0.0;
    c = {hasLambert ? std::max(c.lambert, 0.1 * sum) : 0.0, std::max(c.microfacet, 0.1 * sum), c.multiple};
    const double all = c.lambert + c.microfacet + c.multiple;
    return {c.lambert / all, c.microfacet / all, c.multiple / all};
}

double Glass::reflectionChance(double cosVH) const {
    if (isClear()) return 1.0;
    const Vec3 f = fresnel_(cosVH);
    const double dielectric = 1.0 - p_.metallic;
    const double back = dielectric * luminance(f) + p_.metallic * luminance(metal(cosVH));
    const double on = dielectric * g_.transmission * (1.0 - maxComponent(f)) * luminance(p_.baseColor);
    return on > 0.0 ? back / (back + on) : 1.0;
}

// Of the visible normal H, times dH / dL.
double Glass::transmittedPdf(const Vec3& v, const Vec3& l) const {
    const Vec3 h = normalOf(v, l);
    const double cosVH = glm::dot(v, h), cosLH = glm::dot(l, h);
    const double chance = 1.0 - reflectionChance(cosVH);
    if (!isSolid()) return chance * ggx_.reflectedPdf(v, mirrored(l));
    if (cosVH <= 0.0 || cosLH >= 0.0) return 0.0;
    const double visible = 2.0 * ggx_.distribution(h) * cosVH / (v.z + ggx_.root(v.z));
    const double spread = cosVH + g_.eta * cosLH;
    return chance * visible * g_.eta * g_.eta * -cosLH / (spread * spread);
}

double Glass::pdf(const Vec3& v, const Vec3& l) const {
    if (v.z <= 0.0 || l.z == 0.0) return 0.0;
    const Chances c = chances(v.z);
    double pdf = 0.0;
    if (l.z > 0.0) {
        const double cosVH = glm::dot(v, glm::normalize(v + l));
        pdf = c.lambert * l.z / kPi + c.microfacet * reflectionChance(cosVH) * ggx_.reflectedPdf(v, l);
    } else if (!isClear()) {
        pdf = c.microfacet * transmittedPdf(v, l);
    }
    if (c.multiple == 0.0) return pdf;
    const double side = (l.z > 0.0 ? lostHere_ : lostThere_) / (lostHere_ + lostThere_);
    return pdf + c.multiple * side * std::abs(l.z) / kPi;
}

BsdfSample Glass::sample(const Vec3& v, double uLobe, const Vec2& u) const {
    const Chances c = chances(v.z);
    const Vec3 cosineDirection = direction(std::sqrt(1.0 - u.y), 2.0 * kPi * u.x);
    BsdfSample sample;
    if (uLobe < c.microfacet) {
        const Vec3 h = ggx_.sampleVisibleNormal(v, u);
        const bool isReflected = uLobe < c.microfacet * reflectionChance(glm::dot(v, h));
        if (isReflected)
            sample.direction = reflect(v, h);
        else
            sample.direction = isSolid() ? refract(v, h, g_.eta) : mirrored(reflect(v, h));
        const bool isAbove = sample.direction.z > 0.0;
        if (isReflected != isAbove) return sample; // rejected
    } else if (uLobe < c.microfacet + c.lambert) {
        sample.direction = cosineDirection;
    } else {
        const double share = (uLobe - c.microfacet - c.lambert) / c.multiple;
        const bool isHere = share * (lostHere_ + lostThere_) < lostHere_;
        sample.direction = isHere ? cosineDirection : mirrored(cosineDirection);
    }
    sample.pdf = pdf(v, sample.direction);
    if (sample.pdf > 0.0)
        sample.weight = std::abs(sample.direction.z) / sample.pdf * evaluate(v, sample.direction);
    return sample;
}

} // namespace irradia::reference
