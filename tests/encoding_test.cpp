// Encoding: every kernel against the double-precision twin, gradients by features, and what must not change a
// bit.
#include "shared/network.h"
#include "tests/reference/random.h"
#include "tests/support/encoding_comparison.h"
#include "tests/support/expect_error.h"
#include "tests/support/validated_device.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>
#include <numeric>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr Precision kPrecisions[] = {Precision::Float, Precision::Half};

// Content that is not to be used: 3156.33, or 5.27 twice in half precision.
const double kGarbage = std::bit_cast<float>(0x45454545u);
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

EncodingConfig empty(uint32_t dims) {
    return makeEncoding("Empty", dims);
}
EncodingConfig identity(uint32_t dims, double scale = 1.0, double offset = 0.0) {
    return makeEncoding("Identity", dims, {{"scale", scale}, {"offset", offset}});
}
EncodingConfig frequency(uint32_t dims, double frequencies) {
    return makeEncoding("Frequency", dims, {{"n_frequencies", frequencies}});
}
EncodingConfig triangleWave(uint32_t dims, double frequencies) {
    return makeEncoding("TriangleWave", dims, {{"n_frequencies", frequencies}});
}
EncodingConfig oneBlob(uint32_t dims, double bins, bool gaussian) {
    return makeEncoding("OneBlob", dims, {{"n_bins", bins}, {"kernel", gaussian}});
}
EncodingConfig harmonics(double degree) {
    return makeEncoding("SphericalHarmonics", 3, {{"degree", degree}});
}
EncodingConfig grid(const std::string& otype, uint32_t dims, double levels, double features,
                    bool mean = false) {
    EncodingConfig config =
        makeEncoding(otype, dims,
                     {{"n_levels", levels},
                      {"n_features_per_level", features},
                      {"base_resolution", 4},
                      {"per_level_scale", 1.6}, // levels of 4, 7, 11, 17 and 27 cells an edge
                      {"aggregation", mean}});
    if (otype == "HashGrid") config.keys["log2_hashmap_size"] = 8;
    return config;
}

// Points of a wavy sheet, none of them near the border of a voxel of those levels, where single and double
// precision may see it in different ones.
std::vector<glm::vec3> sheet(size_t count) {
    reference::Random random(1);
    std::vector<glm::vec3> points;
    while (points.size() < count) {
        const double x = random.uniform(), y = random.uniform();
        const glm::vec3 p(x, y, 0.5 + 0.2 * std::sin(6.0 * x));
        const auto isClear = [&](double scale) {
            for (int d = 0; d < 3; ++d)
                if (std::abs(std::remainder(p[d] * scale + 0.5, 1.0)) < 1e-3) return false;
            return true;
        };
        bool isUsed = true;
        for (int l = 0; l < 5; ++l) isUsed = isUsed && isClear(4.0 * std::pow(1.6, l) - 1.0);
        if (isUsed) points.push_back(p);
    }
    return points;
}

EncodingCase gridCase(const std::string& otype, uint32_t dims, double levels, double features, bool mean,
                      Precision precision) {
    EncodingCase made{{grid(otype, dims, levels, features, mean)}, dims, precision, {}};
    if (otype == "SparseGrid") made.touched = sheet(20);
    return made;
}

// All grids, or some in which each choice occurs, at other subgroup sizes than the usual eight a few of
// these: compiling is most of the time.
std::vector<EncodingCase> gridCases() {
    using enum Precision;
    if (!fullSweep()) {
        std::vector<EncodingCase> some{
            gridCase("DenseGrid", 2, 3, 2, false, Float), gridCase("DenseGrid", 3, 3, 1, true, Half),
            gridCase("HashGrid", 3, 4, 2, false, Half),   gridCase("SparseGrid", 3, 3, 4, false, Float),
            gridCase("SparseGrid", 2, 2, 16, true, Half), gridCase("HashGrid", 2, 5, 1, false, Float),
            gridCase("HashGrid", 3, 4, 8, true, Float)};
        if (validatedDevice().subgroupSize() != 8) some.resize(4);
        return some;
    }
    std::vector<EncodingCase> all;
    for (const char* otype : {"DenseGrid", "SparseGrid", "HashGrid"})
        for (const uint32_t dims : {2u, 3u})
            for (const uint32_t features : {1u, 2u, 4u, 8u, 16u})
                for (const bool mean : {false, true})
                    for (const Precision precision : kPrecisions)
                        all.push_back(gridCase(otype, dims, 5, features, mean, precision));
    return all;
}

// Parts with all that they can have in front of them and behind: gaps, neighbours that share a kernel, inputs
// in the middle of a quad, more values than one kernel takes.
std::vector<EncodingCase> compositeCases() {
    std::vector<EncodingCase> cases;
    for (const Precision precision : kPrecisions) {
        cases.push_back({{triangleWave(3, 12), oneBlob(2, 4, false), oneBlob(2, 4, false),
                          oneBlob(1, 4, false), identity(0)},
                         14,
                         precision});
        cases.push_back(
            {{frequency(2, 10), oneBlob(3, 7, true), harmonics(4), identity(2, -2.5, 0.75)}, 10, precision});
    }
    cases.push_back({{harmonics(1), harmonics(2), harmonics(3), oneBlob(1, 64, true)}, 10});
    cases.push_back({{triangleWave(20, 16), oneBlob(2, 64, false)}, 22});
    cases.push_back(
        {{triangleWave(3, 12), empty(2), oneBlob(2, 4, false), empty(1), oneBlob(1, 4, false), empty(0)},
         14});
    return cases;
}

// Of a feature's sum: each contribution of up to 512 rows is rounded to 2^-20, which adds up to five
// deviations of 2^-20 sqrt(512 / 12). Weights err by less: they are those that encode.
constexpr double kGradientTolerance = 3e-5;

// One of each kernel, in a composite.
EncodingCase everyKernel(Precision precision) {
    return {{identity(1), frequency(1, 3), oneBlob(2, 5, false), harmonics(3), grid("HashGrid", 3, 3, 2),
             grid("SparseGrid", 2, 2, 1, true)},
            12,
            precision,
            sheet(20)};
}

} // namespace

TEST_CASE("encodings are those of the twin, among ones") {
    for (const EncodingCase& made : compositeCases()) {
        EncodingHarness harness(made, kGarbage);
        INFO(made.name());
        REQUIRE(harness.encoding().width() == harness.twin().width());
        CHECK(harness.encoding().featureCount() == 0);
        const EncodingBatch batch = harness.randomBatch(512, 1);
        CHECK(encodingError(harness, batch, {}, harness.encode(batch, {})) <= 1.0);
    }
}

TEST_CASE("grids and their gradients are those of the twin") {
    for (const EncodingCase& made : gridCases()) {
        EncodingHarness harness(made, kGarbage);
        INFO(made.name());
        REQUIRE(harness.encoding().width() == harness.twin().width());
        REQUIRE(harness.encoding().featureCount() == harness.twin().featureCount());
        const auto features = harness.randomFeatures(2);
        EncodingBatch batch = harness.randomBatch(257, 3);
        CHECK(encodingError(harness, batch, features, harness.encode(batch, features)) <= 1.0);
        const auto gradient = harness.gradient(batch);
        CHECK(largestDifference(gradient, twinGradient(harness, batch)) < kGradientTolerance);
        batch.encodedGradient[40 * harness.twin().width()] += 0.05; // planted
        CHECK(largestDifference(gradient, twinGradient(harness, batch)) > kGradientTolerance);
    }
}

TEST_CASE("a wrong input, feature or padding is found") {
    const EncodingCase made = everyKernel(Precision::Float);
    EncodingHarness harness(made);
    auto features = harness.randomFeatures(4);
    EncodingBatch batch = harness.randomBatch(64, 5);
    auto encoded = harness.encode(batch, features);
    REQUIRE(encodingError(harness, batch, features, encoded) <= 1.0);

    for (const EncodingTwin::Part& part : harness.twin().parts()) {
        INFO("input " << part.firstInput);
        size_t row = 0; // one that is inside of the cube, where it matters
        const auto input = [&]() -> double& { return batch.inputs[row * made.inputs + part.firstInput]; };
        while (!(input() > 0.1 && input() < 0.9) && row < 63) ++row;
        const double right = input();
        input() += 1e-4;
        CHECK(encodingError(harness, batch, features, encoded) > 1.0);
        input() = right;
    }
    std::swap(features[20], features[21]);
    CHECK(encodingError(harness, batch, features, encoded) > 1.0);
    std::swap(features[20], features[21]);
    const size_t gap = harness.twin().parts()[0].firstValue + 1;
    encoded[gap] = std::nextafter(1.0, 0.0);
    CHECK(encodingError(harness, batch, features, encoded) > 1.0);
}

TEST_CASE("what the approximations differ by") {
    // Of the same x: sine and cosine, triangle wave, one-blobs of four bins.
    EncodingHarness harness(
        {{frequency(1, 1), triangleWave(1, 1), oneBlob(1, 4, false), oneBlob(1, 4, true)}, 4});
    EncodingBatch batch{512, {}, {}};
    for (int i = 0; i < 512; ++i) batch.inputs.insert(batch.inputs.end(), 4, i / 256.0);
    const auto encoded = harness.encode(batch, {});
    double wave = 0.0, blob = 0.0;
    for (size_t row = 0; row < 512; ++row) {
        const double* values = &encoded[row * 16];
        const double cosine = values[1], triangle = values[4];
        wave = std::max(wave, std::abs(triangle - cosine));
        CHECK(triangle * cosine >= 0.0);
        for (size_t bin = 0; bin < 4; ++bin)
            blob = std::max(blob, std::abs(values[8 + bin] - values[12 + bin]));
    }
    // |1 - 2 x - cos(pi x)| is largest where sin(pi x) = 2 / pi, steps of 2^-8 miss that by 2e-5.
    const double x = std::asin(2.0 / reference::kPi) / reference::kPi;
    CHECK(std::abs(wave - std::abs(1.0 - 2.0 * x - std::cos(reference::kPi * x))) < 3e-5);
    // In the middle of a bin: the quartic kernel's deviation is 0.378 bins, the Gaussian's a whole one.
    CHECK(std::abs(blob - (0.79296875 - std::erf(0.5 / std::sqrt(2.0)))) < 1e-6);
}

TEST_CASE("any number of rows, of which no other row or old content changes a bit") {
    for (const Precision precision : kPrecisions) {
        const EncodingCase made = everyKernel(precision);
        EncodingHarness clean(made), garbage(made, kGarbage);
        const auto features = clean.randomFeatures(6);
        const EncodingBatch all = clean.randomBatch(512, 7);
        const auto encoded = clean.encode(all, features);
        for (const uint32_t count : {0u, 1u, 255u, 256u, 257u, 512u}) {
            INFO(count << " rows");
            EncodingBatch batch = all;
            batch.count = count;
            batch.inputs.resize(size_t{count} * made.inputs);
            batch.encodedGradient.resize(size_t{count} * clean.twin().width());
            auto expected = encoded;
            expected.resize(size_t{count} * clean.twin().width());
            CHECK(garbage.encode(batch, features) == expected);
            const auto gradient = clean.gradient(batch);
            CHECK(garbage.gradient(batch) == gradient);
            CHECK(largestDifference(gradient, twinGradient(clean, batch)) < kGradientTolerance);
        }
    }
}

TEST_CASE("gradients by features agree with central differences of the kernels' own values") {
    for (const EncodingCase& made : {gridCase("HashGrid", 2, 5, 1, false, Precision::Float),
                                     gridCase("SparseGrid", 3, 3, 4, false, Precision::Float)}) {
        EncodingHarness harness(made);
        const EncodingBatch batch = harness.randomBatch(64, 8);
        auto features = harness.randomFeatures(9);
        auto gradient = harness.gradient(batch);
        const auto at = [&](size_t feature, double step) {
            features[feature] += step;
            const auto encoded = harness.encode(batch, features);
            features[feature] -= step;
            return std::inner_product(encoded.begin(), encoded.end(), batch.encodedGradient.begin(), 0.0);
        };
        // Values are linear in each feature, so that a large step is exact; what is left is the rounding of
        // 64 rows of values, 1e-7 each, and that of the fixed-point sums.
        constexpr double kTolerance = 2e-5;
        size_t tested = 0;
        for (size_t i = 0; i < gradient.size() && tested < 12; i += 1 + gradient.size() / 40) {
            if (gradient[i] == 0.0) continue;
            const double difference = at(i, 0.5) - at(i, -0.5);
            INFO(made.name() << ", feature " << i);
            CHECK(std::abs(gradient[i] - difference) < kTolerance);
            CHECK(std::abs(1.01 * gradient[i] + 1e-4 - difference) > kTolerance); // planted
            ++tested;
        }
        CHECK(tested == 12);
    }
}

namespace {

EncodingBatch reversed(const EncodingBatch& batch) {
    EncodingBatch turned{batch.count, {}, {}};
    const size_t inputs = batch.inputs.size() / batch.count,
                 width = batch.encodedGradient.size() / batch.count;
    for (size_t row = batch.count; row-- > 0;) {
        const auto append = [&](std::vector<double>& to, const std::vector<double>& from, size_t count) {
            const auto first = from.begin() + static_cast<ptrdiff_t>(row * count);
            to.insert(to.end(), first, first + static_cast<ptrdiff_t>(count));
        };
        append(turned.inputs, batch.inputs, inputs);
        append(turned.encodedGradient, batch.encodedGradient, width);
    }
    return turned;
}

} // namespace

TEST_CASE(
    "gradients have the same bits in any order of rows, on any number of threads, by any form of access") {
    for (const Precision precision : kPrecisions) {
        const EncodingCase made = gridCase("HashGrid", 3, 4, 2, false, precision);
        EncodingHarness harness(made);
        const EncodingBatch batch = harness.randomBatch(511, 10);
        const auto features = harness.randomFeatures(11);
        const auto encoded = harness.encode(batch, features);
        const auto gradient = harness.gradient(batch);
        for (int i = 0; i < 3; ++i) CHECK(harness.gradient(batch) == gradient);
        CHECK(harness.gradient(reversed(batch)) == gradient);

        EncodingHarness storage(made, 0.0, 512, deviceWith(QuadAccess::Storage));
        CHECK(storage.encode(batch, features) == encoded);
        CHECK(storage.gradient(batch) == gradient);

        if (!validatedDevice().isCpu() || precision == Precision::Half) continue;
        const char* before = std::getenv("LP_NUM_THREADS");
        const std::string threads = before ? before : "";
        for (const char* number : {"1", "2", "3"}) {
            setenv("LP_NUM_THREADS", number, 1); // read when a device is made
            Device device;
            EncodingHarness other(made, 0.0, 512, device);
            CHECK(other.encode(batch, features) == encoded);
            CHECK(other.gradient(batch) == gradient);
        }
        before ? setenv("LP_NUM_THREADS", threads.c_str(), 1) : unsetenv("LP_NUM_THREADS");
    }
}

namespace {

// Rows at a corner of a grid of two features, which so get their gradients whole. (Two cells an edge: the
// middle of the square lies at 0.5 + 0.5.)
EncodingConfig squareGrid() {
    EncodingConfig config = grid("DenseGrid", 2, 1, 2);
    config.keys["base_resolution"] = 2;
    return config;
}
constexpr size_t kCornerFeature = 2 * (1 + 3);

EncodingBatch atCorner(const std::vector<std::array<double, 2>>& gradients) {
    EncodingBatch batch{static_cast<uint32_t>(gradients.size()), {}, {}};
    for (const auto& [first, second] : gradients) {
        batch.inputs.insert(batch.inputs.end(), 2, 0.5);
        batch.encodedGradient.insert(batch.encodedGradient.end(), {first, second});
        batch.encodedGradient.resize(batch.inputs.size() / 2 * 16, 0.0);
    }
    return batch;
}

// The sums of the corner's two features, taken; everything else must be zero.
std::array<double, 2> takeCorner(EncodingHarness& harness) {
    auto gradient = harness.takeGradient();
    const std::array<double, 2> taken{gradient[kCornerFeature], gradient[kCornerFeature + 1]};
    gradient[kCornerFeature] = gradient[kCornerFeature + 1] = 0.0;
    CHECK(std::ranges::all_of(gradient, [](double g) { return g == 0.0; }));
    return taken;
}

using Pair = std::array<double, 2>;

} // namespace

TEST_CASE("sums of gradients carry, cut what is huge and leave out what is no number") {
    EncodingHarness harness({{squareGrid()}, 2});
    constexpr double kMost = gpu::kLargestContribution;
    // 32 bits hold one such contribution: the sums carry at each row, up and down. 51,200 of them are exact
    // in single precision (51,175 2^11), and what is taken away again leaves nothing.
    const EncodingBatch huge = atCorner(std::vector<Pair>(512, {1e30, -1e30}));
    harness.accumulate(huge, 100);
    CHECK(takeCorner(harness) == Pair{51200 * kMost, -51200 * kMost});
    harness.accumulate(huge, 100);
    harness.accumulate(atCorner(std::vector<Pair>(512, {-1e30, 1e30})), 100);
    CHECK(takeCorner(harness) == Pair{0.0, 0.0});

    // Whole numbers of both signs, below and beyond the cut, next to each other.
    reference::Random random(12);
    std::vector<Pair> mixed;
    Pair expected{0.0, 0.0};
    for (size_t i = 0; i < 512; ++i) {
        mixed.push_back({std::floor(6000.0 * random.uniform() - 3000.0), i % 2 ? kMost : -kMost - 1.0});
        for (size_t f = 0; f < 2; ++f) expected[f] += std::clamp(mixed[i][f], -kMost, kMost);
    }
    harness.accumulate(atCorner(mixed));
    CHECK(takeCorner(harness) == expected);

    // A row's other feature is not lost with the one that is no number.
    harness.accumulate(atCorner({{kNaN, 1.0}, {kInfinity, 2.0}, {-kInfinity, 3.0}, {0.5, kNaN}}));
    CHECK(takeCorner(harness) == Pair{0.5, 6.0});
    // To the nearest of 2^-20, ties to even.
    harness.accumulate(atCorner({{0x1.8p-21, 0x1p-21}, {0x1p-22, -0x1.8p-20}}));
    CHECK(takeCorner(harness) == Pair{0x1p-20, -0x1p-19});
    CHECK(takeCorner(harness) == Pair{0.0, 0.0});
}

TEST_CASE("half precision's largest gradients are cut, and its infinities left out") {
    EncodingHarness harness({{squareGrid()}, 2, Precision::Half});
    harness.accumulate(atCorner({{65504.0, -65504.0}, {1e30, kNaN}, {1.0, -2.0}})); // 1e30 is infinite there
    CHECK(takeCorner(harness) == Pair{gpu::kLargestContribution + 1.0, -gpu::kLargestContribution - 2.0});
}

TEST_CASE("positions outside of the cube are those at its border, NaN is 0") {
    EncodingHarness harness(gridCase("HashGrid", 3, 4, 2, false, Precision::Float));
    const auto features = harness.randomFeatures(14);
    const EncodingBatch outside{
        4, {-3.0, 0.5, 7e30, 0.25, kNaN, 2.0, kInfinity, -kInfinity, 0.5, 1, 1, 1}, {}};
    const EncodingBatch border{4, {0.0, 0.5, 1.0, 0.25, 0.0, 1.0, 1.0, 0.0, 0.5, 1, 1, 1}, {}};
    const auto encoded = harness.encode(outside, features);
    CHECK(encoded == harness.encode(border, features));
    CHECK(encodingError(harness, border, features, encoded) <= 1.0);
}

TEST_CASE("a sparse grid knows nothing of voxels that no point touches, and all of those that one does") {
    // Points at the borders of voxels and a bit beside them, beyond the cube, and at random; all in its lower
    // half.
    reference::Random random(15);
    std::vector<glm::vec3> points{{0.25f, 0.25f, 0.25f}, {-1.0f, 0.0f, 0.5f}};
    for (int i = 0; i < 300; ++i) {
        glm::vec3 p;
        for (int d = 0; d < 3; ++d) {
            const double cells = 7.0 + 4.8 * (i % 2); // of the first two levels, to a corner
            const auto border = static_cast<float>((std::floor(3.0 * random.uniform()) + 0.5) / cells);
            const float beside[] = {border, std::nextafter(border, 0.0f), std::nextafter(border, 1.0f),
                                    static_cast<float>(0.5 * random.uniform())};
            p[d] = beside[static_cast<size_t>(4.0 * random.uniform())];
        }
        points.push_back(p);
    }
    EncodingConfig config = grid("SparseGrid", 3, 3, 1);
    config.keys["base_resolution"] = 8;
    EncodingHarness harness({{config}, 3, Precision::Float, points});
    const std::vector<double> ones(harness.encoding().featureCount(), 1.0);
    EncodingBatch batch{512, {}, {}};
    for (size_t i = 0; i < 512; ++i) {
        const glm::vec3 p = i < points.size() ? points[i] : 0.8f + 0.4f * points[i % 300 + 2];
        batch.inputs.insert(batch.inputs.end(), {p.x, p.y, p.z});
    }
    const auto encoded = harness.encode(batch, ones);
    for (size_t row = 0; row < 512; ++row)
        for (size_t l = 0; l < 3; ++l) {
            INFO("row " << row << ", level " << l);
            const double value = encoded[row * 16 + l];
            // Weights sum to 1, up to three products of roundings.
            CHECK(std::abs(value - (row < points.size() ? 1.0 : 0.0)) < 1e-6);
        }
}

TEST_CASE("initial features fill their range evenly and follow the seed") {
    const EncodingHarness harness(gridCase("HashGrid", 3, 4, 2, false, Precision::Float));
    const Encoding& encoding = harness.encoding();
    std::vector<float> features(encoding.featureCount()), again = features, other = features;
    encoding.initialise(features, 1);
    encoding.initialise(again, 1);
    encoding.initialise(other, 2);
    CHECK(features == again);
    CHECK(features != other);
    const auto count = static_cast<double>(features.size());
    double sum = 0.0, largest = 0.0;
    for (const float f : features) {
        sum += f / 1e-4 / count;
        largest = std::max(largest, std::abs(f / 1e-4));
    }
    CHECK(std::abs(sum) < 5.0 * std::sqrt(1.0 / 3.0 / count)); // five deviations of the mean
    CHECK(largest <= 1.0 + 1e-6);
    CHECK(largest > 1.0 - 10.0 / count); // missed with a chance of e^-10
    expectError(ExitCode::Internal, fmt::format("not {}", features.size()),
                [&] { encoding.initialise(std::span(features).first(7), 1); });
}

TEST_CASE("parts that do not fit, and grids that are too large, are refused by their numbers") {
    const auto refused = [](ExitCode code, const std::string& named, const std::vector<EncodingConfig>& parts,
                            uint32_t inputs, const std::vector<glm::vec3>& touched = {}) {
        expectError(code, named,
                    [&] { Encoding(validatedDevice(), parts, inputs, Precision::Float, touched); });
    };
    using enum ExitCode;
    refused(BadData, "has no part", {}, 3);
    refused(BadData, "take 3 inputs, there are 4", {identity(3)}, 4);
    refused(BadData, "take 5 inputs, there are 4", {identity(3), identity(2)}, 4);
    refused(BadData, "take 4 and at least one more inputs, there are 4", {identity(4), identity(0)}, 4);
    refused(BadData, "parts 0 and 2 both", {identity(0), identity(1), identity(0)}, 4);
    refused(BadData, "part 1: a grid takes 2 or 3 inputs, not 4", {identity(1), grid("HashGrid", 4, 1, 2)},
            5);
    refused(BadData, "part 0: a grid takes 2 or 3 inputs, not 1", {grid("DenseGrid", 1, 1, 2)}, 1);
    refused(BadData, "part 0: spherical harmonics take 3 inputs, not 2",
            {makeEncoding("SphericalHarmonics", 2)}, 2);
    refused(BadData, "degree 1 to 4, not 5", {harmonics(5)}, 3);
    refused(BadData, "degree 1 to 4, not 0", {harmonics(0)}, 3);
    refused(BadData, "part 0: makes no values", {oneBlob(2, 0, false)}, 2);
    refused(BadData, "1 to 16 levels, not 17", {grid("HashGrid", 3, 17, 2)}, 3);
    refused(BadData, "features a level, not 3", {grid("HashGrid", 3, 2, 3)}, 3);
    refused(BadData, "there are 0", {grid("SparseGrid", 3, 2, 2)}, 3);
    refused(BadData, "point 1 of the SparseGrid's 2 is not finite", {grid("SparseGrid", 3, 2, 2)}, 3,
            {glm::vec3(0.5f), {0.5f, std::numeric_limits<float>::quiet_NaN(), 0.5f}});
    refused(BadData, "level 8 of a SparseGrid has 172 cells an edge, at most 129",
            {grid("SparseGrid", 3, 9, 2)}, 3, sheet(1));
    // 2^24 features have 128 MiB of sums, which is all that lavapipe binds.
    if (!validatedDevice().isCpu()) return;
    EncodingConfig large = grid("HashGrid", 3, 16, 4);
    large.keys["log2_hashmap_size"] = 22;
    large.keys["base_resolution"] = 1u << 10;
    large.keys["per_level_scale"] = 1.0;
    refused(OutOfMemory,
            "33554432 features, whose gradients are 256.0 MiB of sums; a binding holds 128.0 MiB", {large},
            3);
    large.otype = "DenseGrid";
    refused(OutOfMemory, "level 0 of 1024 cells an edge", {large}, 3);
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(validatedDevice().validationMessages() == 0);
    CHECK(deviceWith(QuadAccess::Storage).validationMessages() == 0);
}
