// The isotropic GGX microfacet distribution in the local frame (z = shading normal, all directions unit and z
// > 0). Walter et al. 2007 (D); Heitz 2014, "Understanding the masking-shadowing function" (G1,
// height-correlated G2); Dupuy and Benyoub 2023, "Sampling visible GGX normals with spherical caps"
// (sampling).
#pragma once

#include "tests/reference/math.h"

namespace irradia::reference {

struct Ggx {
    double alpha = 1.0; // (0, 1]

    // Walter et al. 2007, eq. 33: density of microfacet normals per projected solid angle, 1/sr.
    double distribution(const Vec3& h) const {
        const double a2 = alpha * alpha;
        const double t = a2 * h.z * h.z + h.x * h.x + h.y * h.y;
        return a2 / (kPi * t * t);
    }

    // sqrt(alpha^2 + (1 - alpha^2) c^2) = c (1 + 2 Lambda(c)): the root in Heitz 2014, eq. 72.
    double root(double cosine) const {
        const double a2 = alpha * alpha;
        return std::sqrt(a2 + (1.0 - a2) * cosine * cosine);
    }

    // D G2 / (4 N.V N.L) with G2 = 1 / (1 + Lambda(V) + Lambda(L)) (Heitz 2014, eq. 99), 1/sr.
    double specular(const Vec3& v, const Vec3& l) const {
        const double visibility = 0.5 / (l.z * root(v.z) + v.z * root(l.z));
        return distribution(glm::normalize(v + l)) * visibility;
    }

    // G2(V, L) / G1(V): the weight of a sample drawn by sampleVisibleNormal; finite at v.z = 0.
    double maskingRatio(double cosV, double cosL) const {
        return cosL * (cosV + root(cosV)) / (cosL * root(cosV) + cosV * root(cosL));
    }

    // A normal distributed as G1(V) D(H) max(V.H, 0) / N.V; u in [0, 1)^2. A point c on the cap z > -V'.z of
    // the sphere, V' = the view direction in the space where the distribution is a hemisphere.
    Vec3 sampleVisibleNormal(const Vec3& v, const Vec2& u) const {
        const Vec3 stretched = glm::normalize(Vec3(alpha * v.x, alpha * v.y, v.z));
        const Vec3 cap = direction((1.0 - u.y) * (1.0 + stretched.z) - stretched.z, 2.0 * kPi * u.x);
        const Vec3 h = cap + stretched;
        return glm::normalize(Vec3(alpha * h.x, alpha * h.y, std::fmax(h.z, 1e-300)));
    }

    // Density, per solid angle of L, of the reflection of V about such a normal: G1(V) D(H) / (4 N.V).
    double reflectedPdf(const Vec3& v, const Vec3& l) const {
        return distribution(glm::normalize(v + l)) / (2.0 * (v.z + root(v.z)));
    }
};

// Reflection of v about the unit normal h.
inline Vec3 reflect(const Vec3& v, const Vec3& h) {
    return 2.0 * glm::dot(v, h) * h - v;
}

// Schlick's (1 - |V.H|)^5.
inline double schlickWeight(double cosine) {
    const double x = 1.0 - std::fmin(std::abs(cosine), 1.0);
    return x * x * x * x * x;
}

} // namespace irradia::reference
