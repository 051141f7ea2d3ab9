// Errors of pictures against numbers worked out by hand, and FLIP against its authors' program.
#include "engine/image/flip.h"
#include "engine/image/metrics.h"
#include "tests/support/expect_error.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <limits>
#include <numeric>

using namespace irradia;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kExact = 1e-6; // relative: 0.1 and its like are rounded to float on the way in

template <typename Colour>
Rgba8Image makePicture(int width, int height, Colour colour) {
    Rgba8Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c)
                image.pixels.push_back(static_cast<uint8_t>(std::clamp(colour(x, y, c), 0, 255)));
            image.pixels.push_back(255);
        }
    return image;
}

Rgba8Image flat(int r, int g, int b) {
    const int values[] = {r, g, b};
    return makePicture(48, 32, [&](int, int, int c) { return values[c]; });
}

// A picture with slopes, fine texture and edges.
int pattern(int x, int y, int c) {
    return (x * 3 + y * 2 * (c + 1) + (x * y) % 17 * 4 + (x / 8 + y / 8) % 2 * 90) % 256;
}

double meanFlip(const Rgba8Image& test, const Rgba8Image& reference,
                double pixelsPerDegree = kPixelsPerDegree) {
    const auto errors = flipErrors(test, reference, pixelsPerDegree);
    return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

} // namespace

TEST_CASE("errors of two pixels, by hand") {
    const std::vector<glm::vec3> reference{{1, 2, 0}, {0.5f, 0, 4}};
    const std::vector<glm::vec3> test{{1.5f, 2, 0.1f}, {0.5f, 0.2f, 3}};
    const ImageMetrics m = compareImages(2, 1, test, reference);
    CHECK_THAT(m.mse, WithinRel((0.25 + 0.01 + 0.04 + 1) / 6, kExact));
    CHECK_THAT(m.relMse, WithinRel((0.25 / 1.01 + 0.01 / 0.01 + 0.04 / 0.01 + 1 / 16.01) / 6, kExact));
    CHECK_THAT(m.mape, WithinRel((0.5 / 1.01 + 0.1 / 0.01 + 0.2 / 0.01 + 1 / 4.01) / 6, kExact));
    const double referenceLuminance = 0.2126 * 1.5 + 0.7152 * 2 + 0.0722 * 4;
    const double testLuminance = 0.2126 * 2 + 0.7152 * 2.2 + 0.0722 * 3.1;
    CHECK_THAT(m.meanRatio, WithinRel(testLuminance / referenceLuminance, kExact));
    CHECK(m.nonFinite == 0);
    CHECK(m.flip > 0);
}

TEST_CASE("a picture against itself has no error") {
    const std::vector<glm::vec3> picture{{0, 1, 2}, {3, -1, 0.5f}, {100, 0, 0}, {0, 0, 0}};
    const ImageMetrics m = compareImages(2, 2, picture, picture);
    CHECK(m.mse == 0);
    CHECK(m.relMse == 0);
    CHECK(m.mape == 0);
    CHECK(m.meanRatio == 1);
    CHECK(m.flip == 0);
    const std::vector<glm::vec3> black(4, glm::vec3(0));
    CHECK(compareImages(2, 2, black, black).meanRatio == 1);
}

TEST_CASE("values that are not finite are counted and left out") {
    const std::vector<glm::vec3> reference{{1, 1, 1}, {2, 2, 2}, {1, 1, 1}};
    const std::vector<glm::vec3> test{{kNan, 2, 1}, {3, 3, 3}, {kInfinity, -kInfinity, kNan}};
    const ImageMetrics m = compareImages(3, 1, test, reference);
    CHECK(m.nonFinite == 4);
    CHECK_THAT(m.mse, WithinRel((1.0 + 0 + 3) / 5, kExact));
    CHECK_THAT(m.relMse, WithinRel((1 / 1.01 + 3 / 4.01) / 5, kExact));
    CHECK_THAT(m.mape, WithinRel((1 / 1.01 + 3 / 2.01) / 5, kExact));
    CHECK_THAT(m.meanRatio, WithinRel(1.5, kExact)); // the middle pixel alone is whole
    CHECK(std::isfinite(m.flip));
}

TEST_CASE("nothing finite leaves no mean to pass a limit") {
    const ImageMetrics m =
        compareImages(1, 1, std::vector<glm::vec3>{glm::vec3(kNan)}, std::vector<glm::vec3>{glm::vec3(1)});
    CHECK(m.nonFinite == 3);
    CHECK(std::isnan(m.mse));
    CHECK(std::isnan(m.relMse));
    CHECK(std::isnan(m.mape));
    CHECK(std::isnan(m.meanRatio));
}

TEST_CASE("a reference must be finite") {
    const std::vector<glm::vec3> ones(6, glm::vec3(1));
    auto reference = ones;
    reference[4].y = kNan;
    test::expectError(ExitCode::BadData, "(1, 1)", [&] { compareImages(3, 2, ones, reference); });
    test::expectError(ExitCode::Internal, "6", [&] { compareImages(3, 3, ones, ones); });
}

TEST_CASE("errors are red above and blue below the reference, by their share of it") {
    const std::vector<glm::vec3> reference{
        glm::vec3(0.99f), glm::vec3(0.99f), {0, 1, 0}, glm::vec3(0), glm::vec3(1)},
        test{glm::vec3(1.49f), glm::vec3(0.24f), {0, 1, 0}, glm::vec3(0.02f), {1, kNan, 1}};
    const double expected[][2] = {{0.5, 0}, {0, 0.75}, {0, 0}, {2, 0}, {0, 0}};
    const auto signs = errorSigns(5, 1, test, reference);
    for (size_t i = 0; i < signs.size(); ++i) {
        INFO("pixel " << i);
        CHECK_THAT(double(signs[i].r), WithinAbs(expected[i][0], kExact));
        CHECK(signs[i].g == 0.0f);
        CHECK_THAT(double(signs[i].b), WithinAbs(expected[i][1], kExact));
    }
    test::expectError(ExitCode::BadData, "(4, 0)", [&] { errorSigns(5, 1, reference, test); });
}

TEST_CASE("FLIP agrees with its authors' program") {
    // Means over the error maps of NVlabs' FLIP 1.6 (C++, LDR, 67.02 pixels per degree), run on these
    // pictures. It works in float with its own rounding of the colour matrices: 5e-5 is the largest
    // difference seen.
    constexpr double kTolerance = 1e-4;
    const auto of = [](auto colour) {
        return meanFlip(makePicture(96, 64, colour), makePicture(96, 64, pattern));
    };
    const auto noisy = [](int x, int y, int c) {
        return pattern(x, y, c) + (x * 31 + y * 57 + c * 11) % 41 - 20;
    };
    const auto shifted = [](int x, int y, int c) { return pattern(x + 2, y, c); };
    const auto lessRed = [](int x, int y, int c) { return pattern(x, y, c) / (c == 0 ? 2 : 1); };
    const auto inverted = [](int x, int y, int c) { return 255 - pattern(x, y, c); };
    CHECK_THAT(of(noisy), WithinAbs(0.065270, kTolerance));
    CHECK_THAT(of(shifted), WithinAbs(0.430244, kTolerance));
    CHECK_THAT(of(lessRed), WithinAbs(0.480312, kTolerance));
    CHECK_THAT(of(inverted), WithinAbs(0.808265, kTolerance));
}

TEST_CASE("FLIP of black against white, by hand") {
    // Lightness differs by 100, and 100^0.7 = 25.119. CIELAB has green at (87.73, -86.18, 83.18) and blue at
    // (32.30, 79.19, -107.86); with the Hunt effect their HyAB distance is 203.3, the largest, and 203.3^0.7
    // = 41.28.
    const double knee = 0.4 * 41.276;
    const double expected = 0.95 + 0.05 * (25.119 - knee) / (41.276 - knee);
    CHECK_THAT(meanFlip(flat(0, 0, 0), flat(255, 255, 255)), WithinAbs(expected, 1e-5));
    CHECK_THAT(meanFlip(flat(0, 255, 0), flat(0, 0, 255)), WithinAbs(1, 1e-5));
}

TEST_CASE("FLIP is symmetric, grows with the difference and shrinks with distance") {
    const Rgba8Image reference = makePicture(96, 64, pattern);
    CHECK(meanFlip(reference, reference) == 0);
    double previous = 0;
    for (const int step : {2, 6, 15, 40}) {
        const Rgba8Image darker =
            makePicture(96, 64, [&](int x, int y, int c) { return pattern(x, y, c) - step; });
        const double error = meanFlip(darker, reference);
        CHECK(error > previous);
        CHECK_THAT(meanFlip(reference, darker), WithinAbs(error, 1e-9));
        previous = error;
    }
    const Rgba8Image board = makePicture(96, 64, [](int x, int y, int) { return (x + y) % 2 ? 160 : 96; });
    const Rgba8Image grey = makePicture(96, 64, [](int, int, int) { return 128; });
    CHECK(meanFlip(board, grey, 67) < 0.5 * meanFlip(board, grey, 10));
}

TEST_CASE("FLIP refuses pictures of two sizes") {
    test::expectError(ExitCode::BadData, "48 x 32 and 8 x 8",
                      [] { flipErrors(flat(0, 0, 0), makePicture(8, 8, [](int, int, int) { return 0; })); });
}
