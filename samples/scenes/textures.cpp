#include "textures.h"

#include "random.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>

namespace irradia::scenes {

namespace {

uint8_t toByte(float value) {
    return static_cast<uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

// IEC 61966-2-1.
float encodeSrgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

glm::vec3 asSrgb(glm::vec3 linear) {
    return {encodeSrgb(linear.r), encodeSrgb(linear.g), encodeSrgb(linear.b)};
}

// Fills a picture with values 0..1 from f(u, v) at texel centres, v downwards.
Rgba8Image paintRgba(int width, int height, const std::function<glm::vec4(float, float)>& f) {
    Rgba8Image image{width, height, {}};
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const glm::vec4 value = f((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                      (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
            for (float channel : {value.r, value.g, value.b, value.a})
                image.pixels.push_back(toByte(channel));
        }
    }
    return image;
}

Rgba8Image paint(int width, int height, const std::function<glm::vec3(float, float)>& f) {
    return paintRgba(width, height, [&](float u, float v) { return glm::vec4(f(u, v), 1.0f); });
}

float latticeValue(int x, int y, uint32_t seed) {
    return static_cast<float>(hash(static_cast<uint32_t>(x) + hash(static_cast<uint32_t>(y) + hash(seed))) >>
                              8) *
           0x1p-24f;
}

// Smooth value noise 0..1 with `cells` lattice cells over 0..1 in each direction, periodic.
float noise(float u, float v, glm::ivec2 cells, uint32_t seed) {
    const glm::vec2 p = glm::vec2(u, v) * glm::vec2(cells);
    const glm::vec2 cell = glm::floor(p), f = glm::smoothstep(0.0f, 1.0f, p - cell);
    const auto at = [&](int dx, int dy) {
        const int x = static_cast<int>(cell.x) + dx, y = static_cast<int>(cell.y) + dy;
        return latticeValue((x % cells.x + cells.x) % cells.x, (y % cells.y + cells.y) % cells.y, seed);
    };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), f.x), glm::mix(at(0, 1), at(1, 1), f.x), f.y);
}

constexpr float kTilesAcross = 4.0f;

// A tile's surface at (u, v): 0 in the grout, 1 on its flat top.
float tileHeight(float u, float v) {
    const glm::vec2 fromCentre = glm::abs(glm::fract(glm::vec2(u, v) * kTilesAcross) - 0.5f);
    return 1.0f - glm::smoothstep(0.455f, 0.485f, std::max(fromCentre.x, fromCentre.y));
}

uint32_t tileNumber(float u, float v) {
    const glm::ivec2 tile(glm::floor(glm::fract(glm::vec2(u, v)) * kTilesAcross));
    return static_cast<uint32_t>(tile.x + 4 * tile.y);
}

// A leaf's point: along it from stalk to tip, across it from the middle vein out, -1..1, and along its side
// veins, which run outwards and up: whole numbers are veins.
struct LeafPoint {
    float along, across, beside;
};

LeafPoint leafPoint(float u, float v, float sideVeins) {
    const float along = 1.0f - v, across = 2.0f * u - 1.0f;
    return {along, across, sideVeins * (along - 0.22f * std::abs(across))};
}

// Distance to the nearest whole number.
float fromWhole(float x) {
    return std::abs(x - std::floor(x + 0.5f));
}

// Coverage of a point that lies `inside` an outline, in widths of the leaf, over two texels.
float edge(float inside, int size) {
    return glm::clamp(0.5f + 0.5f * inside * static_cast<float>(size), 0.0f, 1.0f);
}

glm::vec3 leafColor(LeafPoint p, glm::vec3 blade, glm::vec3 vein) {
    const float out = std::abs(p.across);
    const float middle = 1.0f - glm::smoothstep(0.02f, 0.07f, out + 0.03f * p.along);
    const float side = 1.0f - glm::smoothstep(0.03f, 0.1f, fromWhole(p.beside));
    const float mottled = 0.8f + 0.2f * noise(0.5f * p.across + 0.5f, p.along, {9, 13}, 41);
    return glm::mix(blade * mottled, vein, std::max(middle, 0.55f * side * (1.0f - 0.6f * out)));
}

} // namespace

TileTextures tiles(int size, glm::vec3 light, glm::vec3 dark) {
    TileTextures textures;
    textures.baseColor = paint(size, size, [&](float u, float v) {
        const uint32_t tile = tileNumber(u, v);
        const bool isDark = (tile + tile / 4) % 2 == 1;
        const float tint =
            latticeValue(static_cast<int>(tile), 7, 1) * 0.2f + noise(u, v, {32, 32}, 2) * 0.1f + 0.75f;
        return asSrgb(glm::mix(glm::vec3(0.22f), (isDark ? dark : light) * tint, tileHeight(u, v)));
    });
    textures.metallicRoughness = paint(size, size, [&](float u, float v) {
        const float glaze = 0.15f + 0.2f * latticeValue(static_cast<int>(tileNumber(u, v)), 3, 4) +
                            0.1f * noise(u, v, {24, 24}, 5);
        return glm::vec3(1.0f, glm::mix(0.9f, glaze, tileHeight(u, v)), 0.0f);
    });
    textures.normal = paint(size, size, [&](float u, float v) {
        const float h = 0.5f / static_cast<float>(size);
        const float depth = 0.006f; // of the grout, in widths of the picture
        const float du = (tileHeight(u + h, v) - tileHeight(u - h, v)) / (2.0f * h) * depth;
        const float dv = (tileHeight(u, v + h) - tileHeight(u, v - h)) / (2.0f * h) * depth;
        return glm::normalize(glm::vec3(-du, dv, 1.0f)) * 0.5f + 0.5f; // v runs down, green points up
    });
    return textures;
}

Rgba8Image floorBoards(int size, glm::vec3 wood) {
    return paint(size, size, [&](float u, float v) {
        const float board = std::floor(v * 8.0f);
        const float shift = latticeValue(static_cast<int>(board), 0, 11);
        const float grain =
            noise(u + shift, v, {6, 96}, 12) * 0.25f + noise(u + shift, v, {24, 192}, 13) * 0.15f;
        const float seam = glm::smoothstep(0.0f, 0.03f, 0.5f - std::abs(glm::fract(v * 8.0f) - 0.5f));
        return asSrgb(wood * (0.55f + 0.25f * shift + grain) * glm::mix(0.35f, 1.0f, seam));
    });
}

Rgba8Image rug(int size, glm::vec3 ground, glm::vec3 figure) {
    return paint(size, size, [&](float u, float v) {
        const glm::vec2 p = glm::abs(glm::vec2(u, v) - 0.5f);
        const float edge = 0.5f - std::max(p.x, p.y);
        const float rhomb = std::abs(glm::fract(u * 6.0f) - 0.5f) + std::abs(glm::fract(v * 6.0f) - 0.5f);
        const bool inBorder = edge > 0.03f && edge < 0.07f;
        const bool inRhomb = edge > 0.1f && (rhomb < 0.2f || (rhomb > 0.32f && rhomb < 0.4f));
        const float weave = 0.85f + 0.15f * noise(u, v, {128, 128}, 21);
        return asSrgb((inBorder || inRhomb ? figure : ground) * weave);
    });
}

Rgba8Image bricks(int size, glm::vec3 wash, glm::vec3 clay) {
    return paint(size, size, [&](float u, float v) {
        const float course = std::floor(v * 8.0f);
        const float along = u * 4.0f + 0.5f * std::fmod(course, 2.0f);
        const glm::vec2 fromCentre = glm::abs(glm::fract(glm::vec2(along, v * 8.0f)) - 0.5f);
        const float joint = std::max(glm::smoothstep(0.46f, 0.49f, fromCentre.x),
                                     glm::smoothstep(0.42f, 0.48f, fromCentre.y));
        const float brick =
            latticeValue(static_cast<int>(std::floor(along)) % 4, static_cast<int>(course), 51);
        const float worn = glm::smoothstep(0.55f, 0.75f, noise(u, v, {11, 17}, 52) * 0.6f + brick * 0.4f);
        const float grain = 0.88f + 0.12f * noise(u, v, {64, 64}, 53);
        return asSrgb(glm::mix(wash, clay * (0.8f + 0.4f * brick), worn) * grain * (1.0f - 0.35f * joint));
    });
}

Rgba8Image toothedLeaf(int size, glm::vec3 blade, glm::vec3 vein) {
    return paintRgba(size, size, [&](float u, float v) {
        const LeafPoint p = leafPoint(u, v, 8.0f);
        const float teeth = 0.07f * (glm::fract(p.beside * 2.0f) - 0.5f);
        const float half = 0.9f * std::pow(std::sin(glm::pi<float>() * std::pow(p.along, 0.75f)), 0.8f);
        return glm::vec4(asSrgb(leafColor(p, blade, vein)), edge(half + teeth - std::abs(p.across), size));
    });
}

Rgba8Image slitLeaf(int size, glm::vec3 blade, glm::vec3 vein) {
    return paintRgba(size, size, [&](float u, float v) {
        const LeafPoint p = leafPoint(u, v, 6.0f);
        const float out = std::abs(p.across);
        const float half = 0.96f * std::pow(std::sin(glm::pi<float>() * std::pow(p.along, 0.6f)), 0.6f);
        const float beside = 0.5f - fromWhole(p.beside); // 0 midway between two side veins
        const float slit = std::max(0.5f * half - out, beside * 0.5f - 0.12f * (out - 0.3f * half));
        const float hole = glm::length(glm::vec2((out - 0.3f) * 0.7f, beside * 0.35f)) - 0.055f;
        return glm::vec4(asSrgb(leafColor(p, blade, vein)), edge(std::min({half - out, slit, hole}), size));
    });
}

Rgba8Image net(int size, glm::vec3 color) {
    return paintRgba(size, size, [&](float u, float v) {
        const bool isBand = fromWhole(6.0f * u) < 0.34f || fromWhole(6.0f * v) < 0.22f;
        return glm::vec4(asSrgb(color * (0.9f + 0.1f * noise(u, v, {48, 48}, 61))), isBand ? 0.9f : 0.4f);
    });
}

Rgba8Image landscape(int width, int height) {
    return paint(width, height, [](float u, float v) {
        const glm::vec3 sky = glm::mix(glm::vec3(0.15f, 0.3f, 0.6f), glm::vec3(0.8f, 0.55f, 0.35f), v * 1.6f);
        glm::vec3 color = glm::min(sky, glm::vec3(0.85f));
        if (glm::distance(glm::vec2(u * 1.5f, v), glm::vec2(1.05f, 0.32f)) < 0.09f)
            color = {0.85f, 0.7f, 0.3f};
        for (int ridge = 0; ridge < 4; ridge++) {
            const float depth = static_cast<float>(ridge) / 3.0f;
            const float top = 0.45f + 0.14f * static_cast<float>(ridge) -
                              0.2f * noise(u, depth, {3 + 2 * ridge, 7}, static_cast<uint32_t>(31 + ridge));
            if (v > top)
                color = glm::mix(glm::vec3(0.3f, 0.35f, 0.5f), glm::vec3(0.05f, 0.12f, 0.06f), depth);
        }
        return asSrgb(color);
    });
}

} // namespace irradia::scenes
