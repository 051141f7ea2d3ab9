// What the generated picture is painted with: noise, coverage of shapes, and strokes that look like writing.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace irradia {

constexpr float kPi = 3.14159265f;
constexpr float kTwoPi = 2 * kPi;

// Three unrelated numbers in [0, 1) for a cell (pcg3d of Jarzynski and Olano 2020).
glm::vec3 cellRandom(glm::ivec2 cell, uint32_t seed);

// Gradient noise (Perlin 2002), about -1..1; one feature a unit.
float noise(glm::vec2 p, uint32_t seed);

// Octaves of noise, each of half the size and weight, down to features of two pixels. `pixel` is the size of
// one in the units of p.
float fractalNoise(glm::vec2 p, float pixel, uint32_t seed, int maxOctaves = 12);

// 0xRRGGBB in sRGB as linear light.
glm::vec3 srgb(uint32_t hex);

glm::vec2 rotated(glm::vec2 p, float angle);

// Signed distances, negative inside.
float boxDistance(glm::vec2 p, glm::vec2 halfSize);
float segmentDistance(glm::vec2 p, glm::vec2 a, glm::vec2 b);
float starDistance(glm::vec2 p, float radius); // eight points: two squares

// A made-up letter in the box 0..1 x 0..1.5: the distance to its pen line, in the units of p.
float glyphDistance(glm::vec2 p, uint32_t letter);

// Paint, one coat over another.
struct Paint {
    glm::vec3 colour{0.0f};
    float pixel = 0.0f; // size of one, in the units of distances

    void over(const glm::vec3& coat, float coverage) {
        colour = glm::mix(colour, coat, glm::clamp(coverage, 0.0f, 1.0f));
    }
    // Where the signed distance is negative, with a soft edge of one pixel.
    void fill(const glm::vec3& coat, float distance, float opacity = 1.0f) {
        over(coat, opacity * glm::clamp(0.5f - distance / pixel, 0.0f, 1.0f));
    }
    void stroke(const glm::vec3& coat, float distance, float width, float opacity = 1.0f) {
        fill(coat, glm::abs(distance) - 0.5f * width, opacity);
    }
};

} // namespace irradia
