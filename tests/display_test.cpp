// What a screen shows of radiance: the sRGB curve, exposure, tone maps, and the colours of numbers.
#include "engine/image/display.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <limits>

using namespace irradia;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The first pixel's red, green and blue.
std::vector<int> shown(glm::vec3 radiance, const DisplayOptions& options) {
    const Rgba8Image image = toDisplay(1, 1, std::vector{radiance}, options);
    return {image.pixels[0], image.pixels[1], image.pixels[2]};
}

} // namespace

TEST_CASE("a screen shows radiance through the sRGB curve") {
    // 255 f(x): f(0.002) = 12.92 x; f(0.18) = 0.46136; f(0.5) = 0.73536
    const std::vector<glm::vec3> radiance{
        {0, 1, 2}, {0.002f, 0.18f, 0.5f}, {kNan, kInfinity, -kInfinity}, {-1, 0.99999f, 1e-9f}};
    const Rgba8Image shown = toDisplay(2, 2, radiance);
    CHECK(shown.width == 2);
    CHECK(shown.height == 2);
    CHECK(shown.pixels ==
          std::vector<uint8_t>{0, 255, 255, 255, 7, 118, 188, 255, 0, 255, 0, 255, 0, 255, 0, 255});
}

TEST_CASE("a stop of exposure doubles the radiance") {
    CHECK(shown({0.09f, 0.25f, 0.001f}, {.exposure = 1.0}) == shown({0.18f, 0.5f, 0.002f}, {}));
    CHECK(shown({4.0f, 2.0f, 1.0f}, {.exposure = -2.0}) == shown({1.0f, 0.5f, 0.25f}, {}));
}

TEST_CASE("tone maps follow their papers") {
    // Reinhard: luminance 1 becomes 1/2, and the colour stays: 255 f(0.5) = 188 of grey; (0.5, 1, 3) has the
    // luminance 1.0381, so its channels are divided by 2.0381: f(0.24533), f(0.49066), 1.
    CHECK(shown(glm::vec3(1.0f), {.toneMap = ToneMap::Reinhard}) == std::vector{188, 188, 188});
    CHECK(shown({0.5f, 1.0f, 3.0f}, {.toneMap = ToneMap::Reinhard}) == std::vector{136, 186, 255});
    // Narkowicz: x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14): 0.18 -> 0.26690, 1 -> 0.80380, 0 -> 0.
    CHECK(shown({0.18f, 1.0f, 0.0f}, {.toneMap = ToneMap::Aces}) == std::vector{141, 232, 0});
    for (const ToneMap toneMap : {ToneMap::Clip, ToneMap::Reinhard, ToneMap::Aces}) {
        CHECK(shown({kInfinity, kInfinity, kInfinity}, {.toneMap = toneMap}) == std::vector{255, 255, 255});
        CHECK(shown({kNan, -1.0f, 0.0f}, {.toneMap = toneMap}) == std::vector{0, 0, 0});
    }
}

TEST_CASE("the automatic exposure brings the median luminance to a grey of 18 %") {
    // Black, NaN and infinite pixels are no part of the picture's brightness.
    const std::vector<glm::vec3> picture{glm::vec3(0.0f), glm::vec3(0.01f),     glm::vec3(0.045f),
                                         glm::vec3(7.0f), glm::vec3(kInfinity), glm::vec3(kNan)};
    CHECK(std::abs(automaticExposure(picture) - 2.0) < 1e-6); // 0.045 is a float
    CHECK(automaticExposure(std::vector(3, glm::vec3(0.0f))) == 0.0);
}

TEST_CASE("the heat map changes its colour with each doubling of a number") {
    const std::pair<float, glm::vec3> colours[] = {
        {-1.0f, {0, 0, 0}}, {0.0f, {0, 0, 0}}, {0.25f, {0, 0, 0.25f}}, {1.0f, {0, 0, 1}},   {2.0f, {0, 1, 1}},
        {4.0f, {0, 1, 0}},  {8.0f, {1, 1, 0}}, {16.0f, {1, 0, 0}},     {1000.0f, {1, 0, 0}}};
    for (const auto& [number, colour] : colours) CHECK(heatColour(number) == colour);
    const glm::vec3 between = heatColour(std::sqrt(32.0f)); // half-way from 4 to 8
    CHECK(between.g == 1.0f);
    CHECK(std::abs(between.r - 0.5f) < 1e-6f); // log2 rounds
}
