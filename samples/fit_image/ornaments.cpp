#include "samples/fit_image/ornaments.h"

#include <algorithm>
#include <cmath>

namespace irradia {
namespace {

const glm::vec3 kInk = srgb(0x141226);
const glm::vec3 kLapis = srgb(0x15246e);
const glm::vec3 kGold = srgb(0xe9b949);
const glm::vec3 kCream = srgb(0xf6ead0);
const glm::vec3 kVermilion = srgb(0xd8321f);
const glm::vec3 kTeal = srgb(0x0f4f57);

// Gold that shines on one side, with a hammered face.
glm::vec3 gilt(glm::vec2 p, float pixel, float shine) {
    return kGold * (0.75f + 0.45f * shine + 0.25f * fractalNoise(40.0f * p, 40.0f * pixel, 51, 3));
}

// Polar coordinates about a dial; `angle` in turns, 0..1.
struct Polar {
    glm::vec2 p;
    float radius;
    float angle;

    explicit Polar(glm::vec2 at)
        : p(at)
        , radius(glm::length(at))
        , angle(glm::fract(std::atan2(at.x, -at.y) / kTwoPi + 1.0f)) {}

    float inRing(float inner, float outer) const { // signed distance
        return std::abs(radius - 0.5f * (inner + outer)) - 0.5f * (outer - inner);
    }
    // Way along the circle from the nearest of `count` spokes.
    float fromSpoke(float count) const {
        return (glm::fract(angle * count + 0.5f) - 0.5f) * kTwoPi * radius / count;
    }
    int spoke(int count) const { // the nearest
        return static_cast<int>(angle * static_cast<float>(count) + 0.5f) % count;
    }
};

void paintLetters(Paint& paint, const Polar& at, float inner, float outer) {
    constexpr int kLetters = 36;
    paint.fill(kLapis, at.inRing(inner, outer));
    const float height = 0.74f * (outer - inner), scale = height / 1.5f;
    const glm::vec2 q((at.fromSpoke(kLetters) / scale) + 0.5f, (outer - at.radius) / scale - 0.26f);
    const float pen = glyphDistance(q, 400u + static_cast<uint32_t>(at.spoke(kLetters))) * scale;
    if (at.inRing(inner, outer) < 0) paint.stroke(kGold * 1.15f, pen, 0.0032f);
}

void paintTicks(Paint& paint, const Polar& at, float inner, float outer) {
    const float ring = at.inRing(inner, outer);
    paint.fill(kCream, ring);
    const float middle = 0.5f * (inner + outer);
    paint.fill(kInk, std::max(ring, std::max(std::abs(at.fromSpoke(180)) - 0.0014f, middle - at.radius)));
    paint.fill(kVermilion, std::max(ring, std::abs(at.fromSpoke(36)) - 0.002f));
}

void paintChecks(Paint& paint, const Polar& at, float inner, float outer) {
    const int row = at.radius > 0.5f * (inner + outer) ? 1 : 0;
    const int column = static_cast<int>(at.angle * 96.0f);
    paint.fill((row + column) % 2 == 0 ? kVermilion : kCream, at.inRing(inner, outer));
}

// Woven sine curves, as banknotes have them.
void paintGuilloche(Paint& paint, const Polar& at, float inner, float outer) {
    const float middle = 0.5f * (inner + outer), swing = 0.44f * (outer - inner);
    paint.fill(glm::mix(kTeal, srgb(0x1b8f86), glm::smoothstep(inner, outer, at.radius)),
               at.inRing(inner, outer));
    for (int curve = 0; curve < 8; ++curve) {
        const float phase = kTwoPi * static_cast<float>(curve) / 8.0f;
        const float wave = kTwoPi * 12.0f * at.angle + phase;
        const float way = at.radius - middle - swing * std::sin(wave);
        const float steep = swing * 12.0f * std::cos(wave) / at.radius; // the curve's slope, for an even pen
        paint.stroke(curve % 2 == 0 ? kGold : srgb(0xa5e8d8), way / std::sqrt(1 + steep * steep), 0.0016f);
    }
}

void paintPlanets(Paint& paint, const Polar& at, float orbit) {
    const glm::vec3 colours[] = {srgb(0xff2a2a), srgb(0x19d3ff), srgb(0xffd400), srgb(0x35e04a),
                                 srgb(0xff7a00), srgb(0xb03cff), srgb(0xff4fa3), srgb(0x2a6bff)};
    constexpr int kPlanets = 8;
    const int planet = at.spoke(kPlanets);
    const float turn = kTwoPi * static_cast<float>(planet) / kPlanets;
    const glm::vec2 q = at.p - orbit * glm::vec2(std::sin(turn), -std::cos(turn));
    const float size = 0.0105f + 0.0035f * static_cast<float>(planet % 3);
    const float light = glm::clamp(0.75f - 30.0f * (q.x + q.y), 0.15f, 1.3f);
    paint.fill(kInk, glm::length(q) - size - 0.003f);
    paint.fill(colours[planet] * light, glm::length(q) - size);
    paint.fill(glm::vec3(1), glm::length(q + 0.35f * size) - 0.18f * size);
}

void paintSun(Paint& paint, const Polar& at) {
    for (int set = 0; set < 2; ++set) { // straight rays over waved ones
        const float waved = set == 0 ? 0.006f * std::sin(140.0f * at.radius) / at.radius / kTwoPi : 0.0f;
        const float turn = glm::fract(at.angle * 12 + 12 * waved + (set == 0 ? 0.5f : 0.0f)) - 0.5f;
        const float along = glm::clamp((at.radius - 0.04f) / (set == 0 ? 0.062f : 0.052f), 0.0f, 1.0f);
        const float ray = (std::abs(turn) - 0.42f * (1 - along)) * kTwoPi * at.radius / 12;
        paint.fill(set == 0 ? srgb(0xe8541a) : srgb(0xffc22e),
                   std::max(ray, at.inRing(0.03f, set == 0 ? 0.102f : 0.092f)));
    }
    const float glow = glm::smoothstep(0.0f, 0.046f, at.radius);
    paint.fill(glm::mix(srgb(0xfff3a0), srgb(0xf08a12), glow), at.radius - 0.046f);
    for (const float circle : {0.044f, 0.036f, 0.028f, 0.020f})
        paint.stroke(srgb(0xa83c08), at.radius - circle, 0.0015f);
    paint.fill(srgb(0x8a1a10), starDistance(at.p, 0.013f));
    paint.fill(kCream, at.radius - 0.005f);
}

// Two strands about the middle of a band; `along` in periods, `across` in half widths.
void paintBraid(Paint& paint, float along, float across, float unit) {
    for (int strand = 0; strand < 3; ++strand) {
        const float phase = kTwoPi * (along + static_cast<float>(strand) / 3.0f);
        const float centre = 0.5f * std::sin(phase);
        const float way = (across - centre) * unit;
        const float slope = std::sqrt(1 + 2.2f * std::cos(phase) * std::cos(phase));
        const glm::vec3 colours[] = {srgb(0xe8432e), kGold, srgb(0x2fb6a8)};
        paint.stroke(kInk, way / slope, 0.0125f);
        paint.stroke(colours[strand] * (0.8f + 0.3f * std::cos(phase)), way / slope, 0.0085f);
        paint.stroke(kCream, way / slope, 0.0016f, 0.7f);
    }
}

// A red letter on a blue field, two lines high.
void paintInitial(Paint& paint, glm::vec2 p) {
    constexpr float kScale = 0.029f;
    const float field = boxDistance(p - 0.025f, glm::vec2(0.022f));
    paint.fill(kLapis, field);
    paint.stroke(kGold, field, 0.002f);
    paint.stroke(srgb(0xff5a3c), glyphDistance((p - glm::vec2(0.011f, 0.0035f)) / kScale, 18u) * kScale,
                 0.0055f);
}

// Four lines of letters, a seventh of them spaces, beside and below an initial; p from the upper left corner.
void paintWriting(Paint& paint, glm::vec2 p, float width) {
    constexpr float kScale = 0.0135f; // width of a letter
    const glm::vec2 pitch(1.12f * kScale, 0.0252f);
    const glm::ivec2 cell(glm::floor(p / pitch));
    const int columns = static_cast<int>(width / pitch.x);
    const bool besideInitial = cell.x < 4 && cell.y < 2;
    const glm::vec3 random = cellRandom(cell, 74);
    if (cell.x < 0 || cell.x >= columns || cell.y < 0 || cell.y >= 4 || besideInitial || random.x < 0.14f)
        return;
    const float pen =
        glyphDistance((p - glm::vec2(cell) * pitch) / kScale, static_cast<uint32_t>(random.z * 26));
    paint.stroke(random.y > 0.94f ? kVermilion : kInk, pen * kScale, 0.0023f);
}

} // namespace

void paintDial(Paint& paint, glm::vec2 p) {
    const Polar at(p);
    if (at.radius > kDialRadius + 0.03f) return;
    paint.fill(kInk, glm::length(p - glm::vec2(0.006f, 0.01f)) - kDialRadius - 0.004f, 0.55f); // its shadow
    paint.fill(gilt(p, paint.pixel, -p.y / kDialRadius), at.radius - kDialRadius);
    paint.stroke(kInk, at.radius - 0.2715f, 0.0018f);
    paintLetters(paint, at, 0.232f, 0.265f);
    paintTicks(paint, at, 0.214f, 0.229f);
    paintChecks(paint, at, 0.196f, 0.211f);
    paintGuilloche(paint, at, 0.145f, 0.193f);
    paint.fill(glm::mix(srgb(0x0a1238), srgb(0x2b1a5c), glm::smoothstep(0.0f, 0.14f, at.radius)),
               at.radius - 0.142f);
    paint.stroke(kGold, at.radius - 0.122f, 0.0014f);
    paintPlanets(paint, at, 0.122f);
    paintSun(paint, at);
}

void paintFrame(Paint& paint, glm::vec2 p, glm::vec2 size) {
    const glm::vec2 toEdge = glm::min(p, size - p);
    const float edge = std::min(toEdge.x, toEdge.y);
    if (edge > kFrameWidth + 0.03f) return;
    paint.fill(kInk, edge - kFrameWidth - 0.007f, 0.6f);
    paint.fill(kLapis * (0.8f + 0.35f * fractalNoise(60.0f * p, 60.0f * paint.pixel, 61, 3)),
               edge - kFrameWidth);
    const bool horizontal = toEdge.y < toEdge.x;
    const float length = horizontal ? size.x : size.y;
    const float periods = std::round(length / 0.085f);
    const float along = (horizontal ? p.x : p.y) / length * periods;
    const float half = 0.5f * kFrameWidth;
    if (edge < kFrameWidth) paintBraid(paint, along, (edge - half) / half, half);
    const glm::vec3 gold = gilt(p, paint.pixel, 0.3f - std::sin(40.0f * edge));
    paint.fill(gold, std::abs(edge - 0.003f) - 0.004f);
    paint.fill(gold, std::abs(edge - kFrameWidth) - 0.004f);
    const float pearls = glm::length(glm::vec2((glm::fract(along * 6) - 0.5f) * 0.0142f, edge - kFrameWidth));
    paint.fill(kCream, pearls - 0.0032f);
    const glm::vec2 corner = toEdge - glm::vec2(half + 0.004f);
    paint.fill(gold, boxDistance(corner, glm::vec2(half + 0.006f)));
    paint.fill(kCream, boxDistance(corner, glm::vec2(half)));
    paint.fill(kVermilion, starDistance(corner, 0.9f * half));
    paint.fill(kLapis, starDistance(rotated(corner, kPi / 8), 0.55f * half));
    paint.fill(kGold, glm::length(corner) - 0.22f * half);
}

void paintSheet(Paint& paint, glm::vec2 p, glm::vec2 halfSize) {
    const float torn = 0.004f * fractalNoise(30.0f * p, 30.0f * paint.pixel, 71, 5);
    const float sheet = boxDistance(p, halfSize - 0.004f) + torn - 0.004f;
    if (sheet > 0.05f) return;
    paint.fill(kInk, boxDistance(p - glm::vec2(0.005f, 0.007f), halfSize), 0.5f);
    const float stain = fractalNoise(7.0f * p, 7.0f * paint.pixel, 72);
    const float fibre = noise(glm::vec2(60.0f, 420.0f) * p, 73);
    paint.fill(kCream * (0.9f + 0.25f * stain + 0.06f * fibre), sheet);
    paint.fill(srgb(0xb98d4e), std::max(sheet, -sheet - 0.012f), 0.35f);
    const glm::vec2 margin(0.018f, 0.014f);
    paintInitial(paint, p + halfSize - margin);
    paintWriting(paint, p + halfSize - margin, 2.0f * (halfSize.x - margin.x));
}

bool coversDial(const Paint& paint, glm::vec2 p) {
    return glm::length(p) < kDialRadius - paint.pixel;
}

bool coversFrame(const Paint& paint, glm::vec2 p, glm::vec2 size) {
    const glm::vec2 toEdge = glm::min(p, size - p);
    return std::min(toEdge.x, toEdge.y) < kFrameWidth - paint.pixel;
}

bool coversSheet(const Paint& paint, glm::vec2 p, glm::vec2 halfSize) {
    return boxDistance(p, halfSize) < -0.008f - paint.pixel; // inside the torn edge
}

} // namespace irradia
