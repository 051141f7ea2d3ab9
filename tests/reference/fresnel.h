// Schlick's reflectance of a dielectric's microfacet: of a surface with one side (opaque ones, sheets), or of
// the interface between two media of indices n_v, on V's side, and n_l. Between media the cosine is the one
// in the thinner medium, so that both directions of a path reflect the same share, and beyond the critical
// angle all is reflected.
#pragma once

#include "tests/reference/ggx.h"
#include <optional>

namespace irradia::reference {

// Cosine, in the thinner medium, of a direction that V's medium has at cosine c; eta = n_l / n_v. None where
// it is reflected totally.
inline std::optional<double> cosineInThinner(double c, double eta) {
    if (eta >= 1.0) return c;
    const double sine2 = (1.0 - c * c) / (eta * eta);
    if (sine2 >= 1.0) return std::nullopt;
    return std::sqrt(1.0 - sine2);
}

// ((eta - 1) / (eta + 1))^2: of normal incidence, by Fresnel's equations.
inline double normalReflectance(double eta) {
    const double ratio = (eta - 1.0) / (eta + 1.0);
    return ratio * ratio;
}

// F0 between two media, from that of the material between its own index and 1.
inline Vec3 f0Between(const Vec3& f0, double ior, double eta) {
    const double own = normalReflectance(ior);
    return own > 0.0 ? glm::min(f0 * (normalReflectance(eta) / own), Vec3(1.0)) : f0;
}

struct DielectricFresnel {
    Vec3 f0{0.04};
    double specular = 1.0; // factor of KHR_materials_specular
    double eta = 1.0;      // n_l / n_v; 1 for surfaces with one side

    bool isTotal(double cosVH) const { return !cosineInThinner(cosVH, eta); }
    Vec3 operator()(double cosVH) const {
        const auto cosine = cosineInThinner(cosVH, eta);
        if (!cosine) return Vec3(1.0);
        return specular * (f0 + (1.0 - f0) * schlickWeight(*cosine));
    }
};

// Direction, on the other side of the microfacet h, into which v (v.h > 0) is refracted; only where it is not
// reflected totally.
inline Vec3 refract(const Vec3& v, const Vec3& h, double eta) {
    const double c = glm::dot(v, h);
    const double cosine = std::sqrt(std::fmax(0.0, 1.0 - (1.0 - c * c) / (eta * eta)));
    return (c / eta - cosine) * h - v / eta;
}

} // namespace irradia::reference
