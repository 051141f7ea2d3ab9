#include "engine/scene/glass_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace irradia {

namespace {

using std::numbers::pi;

// Points of the unit square in a Fibonacci lattice, whose error in the plane is the least of its kind for
// integrands with kinks (Niederreiter 1992, section 5.2): facets have them at the horizon and at the critical
// angle.
constexpr int kPoints = 1597, kGenerator = 987;

struct Point {
    double height;  // in [0, 1)
    double azimuth; // its cosine; the other half of the circle is the mirror image
};

const std::array<Point, kPoints>& lattice() {
    static const std::array<Point, kPoints> kLattice = [] {
        std::array<Point, kPoints> points;
        for (int i = 0; i < kPoints; ++i)
            points[static_cast<size_t>(i)] = {(i + 0.5) / kPoints,
                                              std::cos(pi * (i * kGenerator % kPoints + 0.5) / kPoints)};
        return points;
    }();
    return kLattice;
}

// The root in Smith's masking, G1 = 2 c / (c + root).
double smithRoot(double c, double alpha) {
    return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * c * c);
}

} // namespace

// Visible normals by Dupuy and Benyoub 2023, as sampleVisibleNormal of the shaders.
GlassEnergy::GlassEnergy(double mu, double alpha)
    : mu_(mu)
    , alpha_(alpha)
    , root_(smithRoot(mu, alpha)) {
    const double sine = std::sqrt(std::max(1.0 - mu * mu, 0.0));
    const double stretched = std::hypot(alpha * sine, mu);
    const double viewX = alpha * sine / stretched, viewZ = mu / stretched;
    facets_.reserve(kPoints);
    for (const Point& point : lattice()) {
        const double z = (1.0 - point.height) * (1.0 + viewZ) - viewZ;
        const double across = std::sqrt(std::max(1.0 - z * z, 0.0));
        const double x = alpha * (across * point.azimuth + viewX);
        const double y2 = alpha * alpha * across * across * (1.0 - point.azimuth * point.azimuth);
        const double length = std::sqrt(x * x + y2 + (z + viewZ) * (z + viewZ));
        const double height = (z + viewZ) / length;
        const double cosine = std::clamp(sine * x / length + mu * height, 0.0, 1.0);
        facets_.push_back({cosine, 1.0 - cosine * cosine, height, maskingRatio(2.0 * cosine * height - mu)});
    }
}

double GlassEnergy::maskingRatio(double lz) const {
    return lz > 0.0 ? lz * (mu_ + root_) / (lz * root_ + mu_ * smithRoot(lz, alpha_)) : 0.0;
}

double GlassEnergy::loss(double eta) const {
    const double f0 = (eta - 1.0) * (eta - 1.0) / ((eta + 1.0) * (eta + 1.0));
    double kept = 0.0;
    for (const Facet& facet : facets_) {
        const double square = 1.0 - facet.sine2 / (eta * eta); // of the refracted cosine
        if (square <= 0.0) {
            kept += facet.reflected;
            continue;
        }
        const double refracted = std::sqrt(square);
        const double m = 1.0 - (eta < 1.0 ? refracted : facet.cosine), m2 = m * m;
        const double fresnel = f0 + (1.0 - f0) * m2 * m2 * m;
        const double lz = mu_ / eta - (facet.cosine / eta - refracted) * facet.height;
        kept += fresnel * facet.reflected + (1.0 - fresnel) * maskingRatio(lz);
    }
    return 1.0 - kept / kPoints;
}

} // namespace irradia
