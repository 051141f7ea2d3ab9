#include "spectrum.h"

#include <algorithm>
#include <cmath>

namespace irradia::scenes {

namespace {

// A bell with different widths left and right of its peak.
double lobe(double x, double peak, double left, double right) {
    const double t = (x - peak) / (x < peak ? left : right);
    return std::exp(-0.5 * t * t);
}

// CIE 1931 colour matching functions, multi-lobe fit of Wyman, Sloan and Shirley 2013, "Simple Analytic
// Approximations to the CIE XYZ Color Matching Functions", table 1 (within about 1 % of the standard's
// tables).
glm::dvec3 matching(double nm) {
    return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                0.065 * lobe(nm, 501.1, 20.4, 26.2),
            0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
            1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

// XYZ to linear Rec. 709 with its D65 white (ITU-R BT.709 primaries).
glm::dvec3 toRec709(glm::dvec3 xyz) {
    return {glm::dot(xyz, glm::dvec3(3.2404542, -1.5371385, -0.4985314)),
            glm::dot(xyz, glm::dvec3(-0.9692660, 1.8760108, 0.0415560)),
            glm::dot(xyz, glm::dvec3(0.0556434, -0.2040259, 1.0572252))};
}

} // namespace

glm::vec3 linearRec709(std::span<const float> spectrum, float stepNm) {
    glm::dvec3 xyz(0.0), white(0.0);
    const double last = static_cast<double>(spectrum.size() - 1);
    for (int nm = 400; nm <= 700; nm++) {
        const double at = std::min((nm - 400) / static_cast<double>(stepNm), last);
        const auto i = std::min(static_cast<size_t>(at), spectrum.size() - 2);
        const double value = glm::mix(static_cast<double>(spectrum[i]), static_cast<double>(spectrum[i + 1]),
                                      at - static_cast<double>(i));
        xyz += value * matching(nm);
        white += matching(nm);
    }
    return glm::vec3(toRec709(xyz) / toRec709(white));
}

} // namespace irradia::scenes
