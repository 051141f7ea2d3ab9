// The surface's BSDF: glTF 2.0 Appendix B with KHR_materials_specular and _ior and the project's energy mend,
// in the local frame (z = shading normal). Directions are unit and point away from the surface; V is the side
// of the camera.
//   f = (1 - m) [base / pi (1 - max Fd) min(s(V), s(L)) + Fd spec] + m Fm spec,   spec = D G2 / (4 N.V N.L)
//   Fd = w (f0 + (1 - f0) Fc),  Fm = base + (1 - base) Fc,  Fc = (1 - |V.H|)^5,  s: energy_mend.h
#pragma once

#include "tests/reference/ggx.h"

namespace irradia::reference {

constexpr double kMinAlpha = 1e-3;

// A material at one point, textures applied.
struct BsdfParameters {
    Vec3 baseColor{1.0};    // [0, 1]
    double metallic = 0.0;  // m, [0, 1]
    double roughness = 1.0; // perceptual, [0, 1]; alpha = max(roughness^2, kMinAlpha)
    Vec3 f0{0.04};          // min(((ior - 1) / (ior + 1))^2 specularColor, 1)
    double specular = 1.0;  // w, [0, 1]
};

// Sets of lobes, for evaluation of a part.
enum class Lobes { All, Diffuse, DielectricSpecular, MetalSpecular };

struct BsdfSample {
    Vec3 direction{0.0}; // L
    Vec3 weight{0.0};    // f N.L / pdf; 0 where L is below the horizon
    double pdf = 0.0;    // of all lobes together, 1/sr
};

class Bsdf {
public:
    explicit Bsdf(const BsdfParameters& parameters);

    // f(V, L), 1/sr, without the cosine; 0 unless both directions have z > 0.
    Vec3 evaluate(const Vec3& v, const Vec3& l, Lobes lobes = Lobes::All) const;

    // Density with which sample() draws L, per solid angle; integrates to 1 less the share of rejected
    // samples (GGX reflections below the horizon).
    double pdf(const Vec3& v, const Vec3& l) const;

    // u in [0, 1)^2 for the direction and uLobe in [0, 1) for the lobe: the diffuse one by cosine, or a GGX
    // reflection.
    BsdfSample sample(const Vec3& v, double uLobe, const Vec2& u) const;

    const BsdfParameters& parameters() const { return p_; }
    double alpha() const { return ggx_.alpha; }

private:
    double mend(double mu) const; // s
    double specularProbability(double cosV) const;

    BsdfParameters p_;
    Ggx ggx_;
    bool isPureDiffuse_; // neither metal nor dielectric reflection: s = 1, no GGX lobe
};

// Integral of f N.L over L for V at cosine mu, by quadrature, to about 1e-5 (the energy table's error).
Vec3 directionalAlbedo(const BsdfParameters& parameters, double mu, Lobes lobes = Lobes::All);

} // namespace irradia::reference
