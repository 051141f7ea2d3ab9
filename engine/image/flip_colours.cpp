#include "engine/image/flip_colours.h"

#include <array>
#include <cmath>

namespace irradia {
namespace {

// Columns of a glm matrix are the images of R, G, B: linear Rec. 709 with a D65 white to CIE XYZ (IEC
// 61966-2-1).
const glm::dmat3 kToXyz{
    {0.4124564, 0.2126729, 0.0193339}, {0.3575761, 0.7151522, 0.1191920}, {0.1804375, 0.0721750, 0.9503041}};
const glm::dmat3 kFromXyz = glm::inverse(kToXyz);
const glm::dvec3 kWhite = kToXyz * glm::dvec3(1);

// The sRGB curve undone, for each of its 256 codes.
std::array<double, 256> makeLinearValues() {
    std::array<double, 256> values{};
    for (size_t code = 0; code < values.size(); ++code) {
        const double x = static_cast<double>(code) / 255;
        values[code] = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    }
    return values;
}

double cielabCurve(double t) {
    constexpr double kDelta = 6.0 / 29.0;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
}

} // namespace

double toLinear(uint8_t encoded) {
    static const std::array<double, 256> values = makeLinearValues();
    return values[encoded];
}

glm::dvec3 toYCxCz(const glm::dvec3& linear) {
    const glm::dvec3 n = kToXyz * linear / kWhite;
    return {116 * n.y - 16, 500 * (n.x - n.y), 200 * (n.y - n.z)};
}

glm::dvec3 fromYCxCz(const glm::dvec3& c) {
    const double y = (c.x + 16) / 116;
    return kFromXyz * (glm::dvec3(y + c.y / 500, y, y - c.z / 200) * kWhite);
}

glm::dvec3 toHuntLab(const glm::dvec3& linear) {
    const glm::dvec3 n = kToXyz * linear / kWhite;
    const glm::dvec3 f{cielabCurve(n.x), cielabCurve(n.y), cielabCurve(n.z)};
    const double lightness = 116 * f.y - 16;
    return {lightness, 0.01 * lightness * 500 * (f.x - f.y), 0.01 * lightness * 200 * (f.y - f.z)};
}

double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

} // namespace irradia
