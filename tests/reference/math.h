// Double-precision vectors, a local frame and a few constants of the reference. z is "up" in every local
// frame.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace irradia::reference {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

constexpr double kPi = std::numbers::pi;

inline double maxComponent(const Vec3& v) {
    return std::max(v.x, std::max(v.y, v.z));
}

// Rec. 709 luminance of a linear colour.
inline double luminance(const Vec3& c) {
    return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

// (sin(polar) cos(azimuth), sin(polar) sin(azimuth), cosPolar).
inline Vec3 direction(double cosPolar, double azimuth) {
    const double sinPolar = std::sqrt(std::fmax(0.0, 1.0 - cosPolar * cosPolar));
    return {sinPolar * std::cos(azimuth), sinPolar * std::sin(azimuth), cosPolar};
}

// Right-handed orthonormal frame around a unit normal.
struct Frame {
    Vec3 tangent, bitangent, normal;

    explicit Frame(const Vec3& n)
        : tangent(0.0)
        , bitangent(0.0)
        , normal(n) {
        const Vec3 leastAligned = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
        tangent = glm::normalize(glm::cross(leastAligned, n));
        bitangent = glm::cross(n, tangent);
    }
    Vec3 toLocal(const Vec3& v) const {
        return {glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, normal)};
    }
    Vec3 toWorld(const Vec3& v) const { return v.x * tangent + v.y * bitangent + v.z * normal; }
};

} // namespace irradia::reference
