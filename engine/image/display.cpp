#include "engine/image/image.h"

#include <algorithm>
#include <cmath>

namespace irradia {
namespace {

// IEC 61966-2-1:1999, the exact curve; NaN shows as black.
uint8_t toSrgb8(float radiance) {
    const double x = radiance > 0 ? std::min<double>(radiance, 1.0) : 0.0;
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<uint8_t>(std::lround(255 * encoded));
}

} // namespace

Rgba8Image toDisplay(int width, int height, std::span<const glm::vec3> radiance) {
    Rgba8Image image{width, height, {}};
    image.pixels.reserve(4 * radiance.size());
    for (const glm::vec3& pixel : radiance)
        image.pixels.insert(image.pixels.end(), {toSrgb8(pixel.x), toSrgb8(pixel.y), toSrgb8(pixel.z), 255});
    return image;
}

glm::vec3 heatColour(float number) {
    constexpr glm::vec3 kColours[] = {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
    constexpr int kLast = static_cast<int>(std::size(kColours)) - 1;
    const float at = number < 1.0f ? number : 1.0f + std::log2(number);
    const int low = std::clamp(static_cast<int>(at), 0, kLast - 1);
    return glm::mix(kColours[low], kColours[low + 1], std::clamp(at - static_cast<float>(low), 0.0f, 1.0f));
}

} // namespace irradia
