#include "engine/scene/texture_packing.h"

#include "shared/scene.h"
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

namespace irradia {

float srgbToLinear(uint8_t value) {
    const double c = value / 255.0;
    return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

namespace {

struct LinearImage {
    int width = 0;
    int height = 0;
    std::vector<glm::vec4> texels;
};

LinearImage decode(const TextureImage& image, bool srgb) {
    std::array<float, 256> curve;
    for (int i = 0; i < 256; ++i)
        curve[i] = srgb ? srgbToLinear(static_cast<uint8_t>(i)) : static_cast<float>(i) / 255.0f;
    LinearImage result{image.width, image.height, {}};
    result.texels.resize(size_t(image.width) * size_t(image.height));
    for (size_t i = 0; i < result.texels.size(); ++i) {
        const uint8_t* c = &image.rgba[4 * i];
        result.texels[i] = {curve[c[0]], curve[c[1]], curve[c[2]], static_cast<float>(c[3]) / 255.0f};
    }
    return result;
}

LinearImage halve(const LinearImage& image) {
    LinearImage result{std::max(image.width / 2, 1), std::max(image.height / 2, 1), {}};
    result.texels.reserve(size_t(result.width) * size_t(result.height));
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            const auto at = [&](int dx, int dy) {
                const int sx = std::min(2 * x + dx, image.width - 1);
                const int sy = std::min(2 * y + dy, image.height - 1);
                return image.texels[size_t(sy) * size_t(image.width) + size_t(sx)];
            };
            result.texels.push_back(0.25f * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)));
        }
    }
    return result;
}

glm::uvec2 packHalves(const glm::vec4& v) {
    return {glm::packHalf2x16({v.x, v.y}), glm::packHalf2x16({v.z, v.w})};
}

} // namespace

uint32_t TexturePacker::add(const TextureRef& use, bool srgb) {
    if (use.image < 0) return gpu::kNoTexture;
    const glm::mat3x2& t = use.transform;
    const Use key{use.image, srgb, use.wrapS, use.wrapT, {t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y}};
    const auto [entry, added] = indices_.try_emplace(key, static_cast<uint32_t>(uses_.size()));
    if (added) uses_.push_back(key);
    return entry->second << 1 | static_cast<uint32_t>(use.uvSet & 1);
}

bool TexturePacker::isTransformed(const Use& use) {
    return use.transform != std::array{1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
}

bool TexturePacker::hasTransforms() const {
    return std::ranges::any_of(uses_, isTransformed);
}

void TexturePacker::pack(uint64_t maxTexels, std::vector<glm::uvec4>& quads, std::vector<glm::uvec2>& texels,
                         std::vector<std::string>& warnings) const {
    std::map<std::pair<int, bool>, int> halvings; // of each stored picture
    for (const Use& use : uses_) halvings[{use.image, use.srgb}] = 0;
    const auto texelCount = [&](const std::pair<int, bool>& key, int times) {
        const TextureImage& image = scene_.images[key.first];
        return uint64_t(std::max(image.width >> times, 1)) * uint64_t(std::max(image.height >> times, 1));
    };
    for (;;) {
        uint64_t total = 0;
        for (const auto& [key, times] : halvings) total += texelCount(key, times);
        if (total <= maxTexels) break;
        std::max_element(halvings.begin(), halvings.end(), [&](const auto& a, const auto& b) {
            return texelCount(a.first, a.second) < texelCount(b.first, b.second);
        })->second++;
    }

    struct Placed {
        uint32_t first, width, height;
    };
    std::map<std::pair<int, bool>, Placed> placed;
    for (const auto& [key, times] : halvings) {
        LinearImage image = decode(scene_.images[key.first], key.second);
        for (int i = 0; i < times; ++i) image = halve(image);
        if (times > 0)
            warnings.push_back(fmt::format("texture '{}' was reduced to {}x{} to fit",
                                           scene_.images[key.first].name, image.width, image.height));
        placed[key] = {static_cast<uint32_t>(texels.size()), uint32_t(image.width), uint32_t(image.height)};
        for (const glm::vec4& texel : image.texels) texels.push_back(packHalves(texel));
    }
    auto transform = static_cast<uint32_t>(uses_.size()); // the next one's quad
    for (const Use& use : uses_) {
        const Placed& p = placed.at({use.image, use.srgb});
        const uint32_t wrap = uint32_t(use.wrapS) | uint32_t(use.wrapT) << 2;
        quads.emplace_back(p.first, p.width, p.height, wrap | (isTransformed(use) ? transform << 4 : 0u));
        transform += isTransformed(use) ? 2 : 0;
    }
    for (const Use& use : uses_) {
        if (!isTransformed(use)) continue;
        const auto& t = use.transform;
        quads.push_back(std::bit_cast<glm::uvec4>(glm::vec4(t[0], t[1], t[2], t[3])));
        quads.push_back(std::bit_cast<glm::uvec4>(glm::vec4(t[4], t[5], 0.0f, 0.0f)));
    }
}

} // namespace irradia
