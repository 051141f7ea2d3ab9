// The light from outside: an equirectangular picture, importance sampled in 2D, or a constant, sampled
// uniformly.
#pragma once

#include "engine/scene/scene.h"
#include "tests/reference/discrete_distribution.h"
#include "tests/reference/math.h"

namespace irradia::reference {

class EnvironmentLight {
public:
    explicit EnvironmentLight(const Environment& environment); // which must outlive it

    bool isBlack() const { return power_ <= 0.0; }

    // Radiance from a unit world direction: u = atan2(z, x) / 2 pi + 1/2, v = acos(y) / pi, bilinear at texel
    // centres, wrapped in u, clamped in v.
    Vec3 radiance(const Vec3& direction) const;

    // A world direction in proportion to texel luminance times solid angle; u in [0, 1)^2.
    Vec3 sample(const Vec2& u) const;
    double pdf(const Vec3& direction) const; // per solid angle

private:
    Vec3 texel(int x, int y) const;
    double texelWeight(int x, int y) const;

    const Environment* environment_;
    DiscreteDistribution rows_;
    std::vector<DiscreteDistribution> columns_; // one for each row
    double power_ = 0.0;
};

} // namespace irradia::reference
