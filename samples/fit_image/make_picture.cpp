#include "samples/fit_image/make_picture.h"

#include "engine/image/display.h"
#include "samples/fit_image/ornaments.h"
#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace irradia {
namespace {

// A point of the picture; lengths in its shorter side, y down.
struct Place {
    glm::vec2 p;    // from the upper left corner
    glm::vec2 size; // of the picture
    float height;   // p.y / size.y
};

glm::vec3 skyColour(float height) {
    constexpr int kStops = 6;
    static const glm::vec3 kColours[kStops] = {srgb(0x070a2b), srgb(0x14256e), srgb(0x3f4fa8),
                                               srgb(0xc9618f), srgb(0xff9d5c), srgb(0xffe39a)};
    static constexpr float kAt[kStops] = {0.0f, 0.25f, 0.42f, 0.56f, 0.66f, 0.74f};
    glm::vec3 colour = kColours[0];
    for (int i = 1; i < kStops; ++i)
        colour = glm::mix(colour, kColours[i], glm::smoothstep(kAt[i - 1], kAt[i], height));
    return colour;
}

// Clouds whose noise is displaced by noise, which curls them.
void paintSky(Paint& paint, const Place& at) {
    paint.colour = skyColour(at.height);
    const glm::vec2 p = 3.0f * at.p;
    const float pixel = 3.0f * paint.pixel;
    const glm::vec2 curl(fractalNoise(p, pixel, 11, 5), fractalNoise(p + 17.0f, pixel, 12, 5));
    const float cloud = fractalNoise(p + 1.6f * curl, pixel, 13);
    const float wisps = fractalNoise(glm::vec2(2, 7) * at.p + 0.9f * curl, 7.0f * paint.pixel, 14);
    paint.over(srgb(0x18a7b0), 1.5f * glm::smoothstep(0.0f, 0.55f, cloud) * (1 - at.height));
    paint.over(srgb(0x8a2be0), 0.9f * glm::smoothstep(0.05f, 0.5f, curl.x - 0.4f * cloud) * (1 - at.height));
    paint.over(srgb(0xffd9c0),
               0.9f * glm::smoothstep(0.05f, 0.45f, wisps) * glm::smoothstep(0.3f, 0.7f, at.height));
    for (int layer = 0; layer < 3; ++layer) { // stars
        const float cells = 18.0f * std::exp2(static_cast<float>(layer));
        const glm::ivec2 cell(glm::floor(at.p * cells));
        const glm::vec3 random = cellRandom(cell, 20u + static_cast<uint32_t>(layer));
        const glm::vec2 centre = (glm::vec2(cell) + 0.2f + 0.6f * glm::vec2(random)) / cells;
        const float radius = (0.03f + 0.06f * random.z * random.z) / cells;
        paint.fill(glm::mix(glm::vec3(1), srgb(0xffd27a), random.y), glm::length(at.p - centre) - radius,
                   glm::smoothstep(0.62f, 0.3f, at.height));
    }
}

// The height of a ridge at x: noise folded at zero, which makes peaks.
float ridgeTop(float x, int ridge, float pixel) {
    const float scale = 2.2f + 0.9f * static_cast<float>(ridge);
    const glm::vec2 p(scale * x + 9.7f * static_cast<float>(ridge), 0.5f);
    return 0.5f - std::abs(fractalNoise(p, scale * pixel, 30u + 16u * static_cast<uint32_t>(ridge)));
}

// Rock: lit from the left by the slope of noise, with bands of strata and snow on the two farther ridges.
glm::vec3 rock(glm::vec2 p, float below, int ridge, float pixel) {
    static const glm::vec3 kHaze = srgb(0xd98a8e), kRock = srgb(0x2c2a4a), kMoss = srgb(0x17381f);
    const float depth = static_cast<float>(ridge) / 3.0f;
    const float scale = 14.0f;
    const uint32_t seed = 40u + static_cast<uint32_t>(ridge);
    const auto relief = [&](glm::vec2 q) { return fractalNoise(scale * q, scale * pixel, seed); };
    const float light = (relief(p + glm::vec2(0.003f, 0.002f)) - relief(p)) * 9.0f;
    glm::vec3 colour = glm::mix(kHaze, ridge == 3 ? kMoss : kRock, 0.35f + 0.6f * depth);
    colour *= 1.0f + glm::clamp(light, -0.75f, 1.6f);
    colour *= 1.0f + 0.18f * std::sin(420.0f * (below + 0.02f * relief(0.3f * p)));
    const float snow = 0.035f + 0.06f * relief(0.7f * p + 5.0f) + 0.03f * light;
    if (ridge < 2 && below < snow)
        colour = glm::vec3(0.93f, 0.9f, 0.97f) * (0.8f + 0.35f * glm::clamp(light, -1.0f, 1.0f));
    return colour;
}

// Firs on a line: triangles of varying height, their edges cut into branches.
float firDistance(glm::vec2 p, float ground, int row) {
    const float spacing = 0.017f;
    const int tree = static_cast<int>(std::floor(p.x / spacing));
    const glm::vec3 random = cellRandom({tree, row}, 55);
    const float height = 0.022f + 0.04f * random.x;
    const float up = (ground - p.y) / height; // 0 at the foot, 1 at the tip
    const float branch = 0.7f + 0.3f * glm::fract(5.0f * up);
    const float x = std::abs(p.x - (static_cast<float>(tree) + 0.35f + 0.3f * random.y) * spacing);
    return std::max(x - 0.32f * height * (1 - up) * branch * 0.75f, -up * height);
}

constexpr int kRidges = 4;

// Ridges from far to near; of those that a nearer one hides nothing is painted, nor of the sky behind.
void paintSkyAndLand(Paint& paint, const Place& at) {
    float below[kRidges];
    int first = -1; // the nearest that hides all behind it, -1 for the sky
    for (int ridge = 0; ridge < kRidges; ++ridge) {
        const float n = static_cast<float>(ridge);
        const float base = (0.70f + 0.055f * n) * at.size.y + 0.05f;
        below[ridge] = at.p.y - base + (0.26f - 0.035f * n) * ridgeTop(at.p.x, ridge, paint.pixel);
        if (below[ridge] > paint.pixel) first = ridge;
    }
    if (first < 0) paintSky(paint, at);
    for (int ridge = std::max(first, 0); ridge < kRidges; ++ridge) {
        const float ground = at.p.y - below[ridge] + 0.006f;
        if (ridge >= 2 && ridge > first)
            paint.fill(srgb(ridge == 2 ? 0x1f3f3a : 0x07180f), firDistance(at.p, ground, ridge));
        if (below[ridge] > -paint.pixel)
            paint.fill(rock(at.p, below[ridge], ridge, paint.pixel), -below[ridge]);
    }
}

glm::vec3 paintPoint(const Place& at, float pixel) {
    Paint paint;
    paint.pixel = pixel;
    const glm::vec2 fromDial = at.p - glm::vec2(0.5f * at.size.x, 0.4f * at.size.y);
    const glm::vec2 sheet(0.5f * at.size.x - kFrameWidth - 0.045f, 0.063f);
    const glm::vec2 fromSheet =
        at.p - glm::vec2(0.5f * at.size.x, at.size.y - kFrameWidth - 0.033f - sheet.y);
    const bool hidden = coversDial(paint, fromDial) || coversFrame(paint, at.p, at.size) ||
                        coversSheet(paint, fromSheet, sheet);
    if (!hidden) paintSkyAndLand(paint, at);
    paintDial(paint, fromDial);
    paintSheet(paint, fromSheet, sheet);
    paintFrame(paint, at.p, at.size);
    const float grain = noise(at.p / (2.5f * pixel), 91) + noise(90.0f * at.p, 92);
    return glm::clamp(paint.colour * (1.0f + 0.035f * grain), 0.0f, 1.0f);
}

// The mean of 2 x 2 points of a pixel.
glm::vec3 paintPixel(glm::uvec2 pixel, glm::uvec2 size) {
    const float unit = 1.0f / static_cast<float>(std::min(size.x, size.y));
    glm::vec3 sum(0);
    for (int i = 0; i < 4; ++i) {
        const glm::vec2 inside(0.25f + 0.5f * static_cast<float>(i % 2),
                               0.25f + 0.5f * static_cast<float>(i / 2));
        const glm::vec2 p = (glm::vec2(pixel) + inside) * unit, whole = glm::vec2(size) * unit;
        sum += paintPoint({p, whole, p.y / whole.y}, unit);
    }
    return 0.25f * sum;
}

} // namespace

Rgba8Image makePicture(glm::uvec2 size) {
    std::vector<glm::vec3> pixels(size_t{size.x} * size.y);
    std::atomic<uint32_t> nextRow = 0;
    const auto paintRows = [&] {
        for (uint32_t y = nextRow++; y < size.y; y = nextRow++)
            for (uint32_t x = 0; x < size.x; ++x) pixels[size_t{y} * size.x + x] = paintPixel({x, y}, size);
    };
    std::vector<std::jthread> threads;
    for (uint32_t i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
        threads.emplace_back(paintRows);
    threads.clear(); // waits
    return toDisplay(static_cast<int>(size.x), static_cast<int>(size.y), pixels);
}

} // namespace irradia
