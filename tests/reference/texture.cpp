#include "tests/reference/texture.h"
#include <algorithm>
#include <array>

namespace irradia::reference {

namespace {

// IEC 61966-2-1, from 8 bits.
const std::array<double, 256> kSrgbToLinear = [] {
    std::array<double, 256> table{};
    for (int i = 0; i < 256; ++i) {
        const double x = i / 255.0;
        table[i] = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    }
    return table;
}();

glm::dvec4 texel(const TextureImage& image, int x, int y, Encoding encoding) {
    const uint8_t* rgba = &image.rgba[4 * (static_cast<size_t>(y) * image.width + x)];
    const auto decode = [&](uint8_t value) {
        return encoding == Encoding::Srgb ? kSrgbToLinear[value] : value / 255.0;
    };
    return {decode(rgba[0]), decode(rgba[1]), decode(rgba[2]), rgba[3] / 255.0};
}

int wrapped(int64_t index, int size, Wrap wrap) {
    const auto modulo = [](int64_t i, int64_t n) { return ((i % n) + n) % n; };
    int64_t i = index;
    switch (wrap) {
    case Wrap::Repeat:
        i = modulo(i, size);
        break;
    case Wrap::MirroredRepeat:
        i = modulo(i, 2 * static_cast<int64_t>(size));
        if (i >= size) i = 2 * static_cast<int64_t>(size) - 1 - i;
        break;
    case Wrap::ClampToEdge:
        i = std::clamp<int64_t>(i, 0, size - 1);
        break;
    }
    return static_cast<int>(i);
}

} // namespace

glm::dvec4 sampleTexture(const Scene& scene, const TextureRef& texture, const Vec2& uv, Encoding encoding) {
    if (texture.image < 0) return glm::dvec4(1.0);
    const TextureImage& image = scene.images[texture.image];
    const Vec2 at = glm::dmat3x2(texture.transform) * Vec3(uv, 1.0);
    const double x = at.x * image.width - 0.5, y = at.y * image.height - 0.5;
    const double x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
    glm::dvec4 sum(0.0);
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
            const int column = wrapped(static_cast<int64_t>(x0) + dx, image.width, texture.wrapS);
            const int row = wrapped(static_cast<int64_t>(y0) + dy, image.height, texture.wrapT);
            sum += (dx ? fx : 1.0 - fx) * (dy ? fy : 1.0 - fy) * texel(image, column, row, encoding);
        }
    return sum;
}

Vec3 meanColor(const Scene& scene, const TextureRef& texture, Encoding encoding) {
    if (texture.image < 0) return Vec3(1.0);
    const TextureImage& image = scene.images[texture.image];
    Vec3 sum(0.0);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) sum += Vec3(texel(image, x, y, encoding));
    return sum / (static_cast<double>(image.width) * image.height);
}

} // namespace irradia::reference
