#include "engine/image/display.h"

#include <algorithm>
#include <cmath>

namespace irradia {
namespace {

constexpr double kMiddleGrey = 0.18;

// IEC 61966-2-1:1999, the exact curve.
uint8_t toSrgb8(double light) {
    const double x = light > 0 ? std::min(light, 1.0) : 0.0;
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<uint8_t>(std::lround(255 * encoded));
}

double aces(double x) {
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

// In [0, 1e30], where no curve overflows.
double usable(double radiance) {
    return radiance > 0 ? std::min(radiance, 1e30) : 0.0;
}

glm::dvec3 toScreen(const glm::vec3& radiance, double scale, ToneMap toneMap) {
    const glm::dvec3 exposed(usable(scale * radiance.x), usable(scale * radiance.y),
                             usable(scale * radiance.z));
    switch (toneMap) {
    case ToneMap::Reinhard:
        return exposed / (1.0 + luminance(glm::vec3(exposed)));
    case ToneMap::Aces:
        return {aces(exposed.x), aces(exposed.y), aces(exposed.z)};
    default:
        return exposed;
    }
}

} // namespace

Rgba8Image toDisplay(int width, int height, std::span<const glm::vec3> radiance,
                     const DisplayOptions& options) {
    const double scale = std::exp2(options.exposure);
    Rgba8Image image{width, height, {}};
    image.pixels.reserve(4 * radiance.size());
    for (const glm::vec3& pixel : radiance) {
        const glm::dvec3 light = toScreen(pixel, scale, options.toneMap);
        image.pixels.insert(image.pixels.end(), {toSrgb8(light.x), toSrgb8(light.y), toSrgb8(light.z), 255});
    }
    return image;
}

double automaticExposure(std::span<const glm::vec3> radiance) {
    std::vector<double> lit;
    for (const glm::vec3& pixel : radiance) {
        const double value = luminance(pixel);
        if (value > 0 && std::isfinite(value)) lit.push_back(value);
    }
    if (lit.empty()) return 0.0;
    const auto middle = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() / 2);
    std::nth_element(lit.begin(), middle, lit.end());
    return std::log2(kMiddleGrey / *middle);
}

double luminance(const glm::vec3& rgb) {
    return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

glm::vec3 heatColour(float number) {
    constexpr glm::vec3 kColours[] = {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
    constexpr int kLast = static_cast<int>(std::size(kColours)) - 1;
    const float at = number < 1.0f ? number : 1.0f + std::log2(number);
    const int low = std::clamp(static_cast<int>(at), 0, kLast - 1);
    return glm::mix(kColours[low], kColours[low + 1], std::clamp(at - static_cast<float>(low), 0.0f, 1.0f));
}

} // namespace irradia
