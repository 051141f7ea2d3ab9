// The BSDF of a surface that transmits, over the whole sphere: the opaque one of bsdf.h, its Lambert lobe
// weighted by 1 - tau, and what comes through instead. Local frame, V.z > 0; L.z < 0 is the other side, where
// the index of refraction is eta times that of V's. With F = Fd (fresnel.h), m, w and s as in bsdf.h:
//   f = (1 - m) [(1 - tau) base / pi (1 - max F) min(s(V), s(L)) + F spec + tau (t + f_ms)] + m Fm spec
// t: rough sheets transmit as they reflect, mirrored to the other side; of solids Walter et al. 2007, eq. 21,
//   with the height-correlated G2 of Heitz 2014 in the form for reflection; both times base (1 - max F).
// f_ms: scattered between microfacets many times, Kulla and Conty 2017, with the light each side can hold:
//   n_v^2 (1 - E(V)) (1 - E(L)) / N,  N = pi (n_v^2 (1 - Eavg_v) + n_l^2 (1 - Eavg_l)),  times base if
//   transmitted.
// So white glass is white in a white furnace, and f(V, L) / n_v^2 = f(L, V) / n_l^2. Within the denser medium
// s is that of the refracted direction, and 0 where there is none: a surface that reflects all has no diffuse
// light to give.
#pragma once

#include "tests/reference/bsdf.h"
#include "tests/reference/fresnel.h"
#include "tests/reference/glass_energy.h"

namespace irradia::reference {

struct GlassParameters {
    // A clear sheet lets light pass straight on, which is no scattering and not in this BSDF (passing.h).
    enum class Kind { ClearSheet, RoughSheet, Solid };

    Kind kind = Kind::Solid;
    double transmission = 1.0; // tau, [0, 1]
    double eta = 1.5;          // n_l / n_v of solids; not 1
};

enum class GlassLobes { All, Lambert, Reflection, Transmission, MultipleScattering };

class Glass {
public:
    // f0 of the surface: of solids that between the two media (f0Between).
    Glass(const BsdfParameters& surface, const GlassParameters& glass);

    // f(V, L), 1/sr, without the cosine; 0 unless V.z > 0 and L.z is not 0.
    Vec3 evaluate(const Vec3& v, const Vec3& l, GlassLobes lobes = GlassLobes::All) const;

    // Density with which sample() draws L, per solid angle; integrates to 1 less the share of rejected
    // samples (microfacets that reflect below the horizon or refract above it).
    double pdf(const Vec3& v, const Vec3& l) const;

    // u in [0, 1)^2 for the direction, uLobe in [0, 1) for the lobe and the side. weight = f |L.z| / pdf.
    BsdfSample sample(const Vec3& v, double uLobe, const Vec2& u) const;

    // (n_l / n_v)^2 if L is on the other side, else 1: radiance times it is the share of light.
    double etendue(const Vec3& l) const { return isSolid() && l.z < 0.0 ? g_.eta * g_.eta : 1.0; }

    double alpha() const { return ggx_.alpha; }
    const BsdfParameters& surface() const { return p_; }
    const GlassParameters& glass() const { return g_; }

    // Factor of the Lambert lobe that keeps it within what reflection leaves, at cosine mu.
    double mend(double mu) const;

    // Of what single scattering loses, the share that scattering many times gives back: E is that of w = 1
    // and the indices' F0, and linear in F; what F is besides gives nothing back, which keeps the sum
    // below 1. Of sheets all.
    double returnedShare() const;

private:
    struct Chances {
        double lambert, microfacet, multiple; // sum 1
    };
    bool isSolid() const { return g_.kind == GlassParameters::Kind::Solid; }
    bool isClear() const { return g_.kind == GlassParameters::Kind::ClearSheet; }
    bool scattersManyTimes() const { return !isClear() && ggx_.alpha > kMinAlpha; }
    Vec3 metal(double cosVH) const; // Fm

    Chances chances(double cosV) const;
    double reflectionChance(double cosVH) const; // of a microfacet rather than transmission

    Vec3 lambert(const Vec3& v, const Vec3& l) const;
    Vec3 reflected(const Vec3& v, const Vec3& l) const;
    Vec3 transmitted(const Vec3& v, const Vec3& l) const;
    Vec3 multiple(const Vec3& v, const Vec3& l) const;
    Vec3 normalOf(const Vec3& v, const Vec3& l) const; // H of a transmission
    double transmittedPdf(const Vec3& v, const Vec3& l) const;

    BsdfParameters p_;
    GlassParameters g_;
    Ggx ggx_;
    DielectricFresnel fresnel_;
    const GlassEnergy* energyHere_;  // on V's side
    const GlassEnergy* energyThere_; // on the other
    // What scattering many times gives to each side, as shares of light: 1 - Eavg, the other side's times
    // (n_l / n_v)^2. Their sum times pi is N / n_v^2.
    double lostHere_ = 0.0, lostThere_ = 0.0;
};

} // namespace irradia::reference
