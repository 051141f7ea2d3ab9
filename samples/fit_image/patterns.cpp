#include "samples/fit_image/patterns.h"

#include "samples/fit_image/srgb.h"
#include <algorithm>
#include <cmath>

namespace irradia {
namespace {

glm::uvec3 pcg3d(glm::uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

// The gradient of a lattice point, one of eight directions, times the way from it.
float slope(glm::ivec2 cell, glm::vec2 way, uint32_t seed) {
    constexpr float kDiagonal = 0.70710678f;
    constexpr glm::vec2 kDirections[8] = {
        {1, 0},  {kDiagonal, kDiagonal},   {0, 1},  {-kDiagonal, kDiagonal},
        {-1, 0}, {-kDiagonal, -kDiagonal}, {0, -1}, {kDiagonal, -kDiagonal}};
    return glm::dot(kDirections[pcg3d(glm::uvec3(glm::uvec2(cell), seed)).x >> 29], way);
}

} // namespace

glm::vec3 cellRandom(glm::ivec2 cell, uint32_t seed) {
    return glm::vec3(pcg3d(glm::uvec3(glm::uvec2(cell), seed)) >> 8u) * 0x1p-24f;
}

float noise(glm::vec2 p, uint32_t seed) {
    const glm::vec2 base = glm::floor(p), f = p - base;
    const glm::vec2 w = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    const glm::ivec2 cell(base);
    const auto at = [&](int x, int y) { return slope(cell + glm::ivec2(x, y), f - glm::vec2(x, y), seed); };
    return 1.5f * glm::mix(glm::mix(at(0, 0), at(1, 0), w.x), glm::mix(at(0, 1), at(1, 1), w.x), w.y);
}

float fractalNoise(glm::vec2 p, float pixel, uint32_t seed, int maxOctaves) {
    float sum = 0, weight = 0.5f;
    for (int octave = 0; octave < maxOctaves && (octave == 0 || 2 * pixel < 1); ++octave) {
        sum += weight * noise(p, seed + static_cast<uint32_t>(octave));
        weight *= 0.5f;
        pixel *= 2;
        p = rotated(2.0f * p, 0.6f); // else the lattices' axes show
    }
    return sum;
}

glm::vec3 srgb(uint32_t hex) {
    const auto linear = [](uint32_t byte) { return decodeSrgb(static_cast<float>(byte & 0xffu) / 255.0f); };
    return {linear(hex >> 16), linear(hex >> 8), linear(hex)};
}

glm::vec2 rotated(glm::vec2 p, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * p.x - s * p.y, s * p.x + c * p.y};
}

float boxDistance(glm::vec2 p, glm::vec2 halfSize) {
    const glm::vec2 q = glm::abs(p) - halfSize;
    return glm::length(glm::max(q, 0.0f)) + std::min(std::max(q.x, q.y), 0.0f);
}

float segmentDistance(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
    const glm::vec2 way = b - a;
    const float t = glm::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0f, 1.0f);
    return glm::length(p - a - t * way);
}

float starDistance(glm::vec2 p, float radius) {
    const glm::vec2 q = rotated(p, kPi / 4);
    const float half = radius * 0.70710678f;
    return std::min(boxDistance(p, glm::vec2(half)), boxDistance(q, glm::vec2(half)));
}

float glyphDistance(glm::vec2 p, uint32_t letter) {
    // A stem on the left or in the middle, and two or three strokes between knots of a 3 x 4 lattice.
    const auto knot = [](uint32_t bits) {
        return glm::vec2(0.15f + 0.35f * static_cast<float>(bits % 3),
                         0.1f + 0.42f * static_cast<float>(bits / 3 % 4));
    };
    const glm::uvec3 bits = pcg3d({letter, 77u, 5u});
    const float stem = (bits.x & 1u) ? 0.15f : 0.5f;
    float distance = segmentDistance(p, {stem, 0.1f}, {stem, 1.36f});
    uint32_t from = bits.y;
    for (uint32_t stroke = 0; stroke < 2 + (bits.x >> 1) % 2; ++stroke) {
        const uint32_t to = from / 12 + 5 * stroke + 1;
        const glm::vec2 a = knot(from % 12), b = knot(to % 12);
        if (a != b) distance = std::min(distance, segmentDistance(p, a, b));
        from = to * 2654435761u;
    }
    if (bits.z & 1u) { // a bow
        const glm::vec2 centre(0.5f, (bits.z & 2u) ? 0.46f : 1.0f);
        distance = std::min(distance, std::abs(glm::length(p - centre) - 0.33f));
    }
    return distance;
}

} // namespace irradia
