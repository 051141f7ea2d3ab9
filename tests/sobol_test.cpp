// The numbers of a path's decisions under --sampler sobol: the twin's bits, points that are spread as Sobol'
// says over samples and over the pixels of a tile, uniform, and independent of other blocks, tiles and seeds.
#include "kernels/shaders.h"
#include "shared/path.h"
#include "tests/reference/sobol.h"
#include "tests/reference/statistics.h"
#include "tests/shaders/harness.h"
#include "tests/support/kernel_harness.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <functional>
#include <map>

using namespace irradia;
using reference::Words;

namespace {

constexpr uint32_t kSeed = 3;
constexpr uint32_t kPoints = 1u << 16; // of a sequence
constexpr uint32_t kWidth = 32768;     // of the picture
constexpr uint32_t kTileSide = 16;

using Points = std::vector<glm::uvec4>;

// `samples` samples of each of `pixels` pixels, one pixel after the other.
Points draw(const glm::uvec4& first, uint32_t pixels, uint32_t samples, uint32_t which = gpu::kSamplerBlock,
            uint32_t sampler = gpu::kSamplerSobol, uint32_t width = kWidth) {
    // Never destroyed: made before the device, it would outlive the validation layer.
    static auto& kernels = *new std::map<uint32_t, test::KernelHarness>;
    const auto kernel = kernels
                            .try_emplace(sampler, kernels::sampler_path_bits,
                                         std::vector<Specialisation>{{gpu::kConstantSampler, sampler}})
                            .first;
    const uint32_t count = pixels * samples;
    return kernel->second.run({}, gpu::SamplerHarnessParams{first, samples, count, which, width}, count,
                              count);
}

double unit(uint32_t bits) {
    return (bits >> 8) * 0x1p-24;
}

} // namespace

// ---- the twin ----

TEST_CASE("Sobol' points are the twin's, bit for bit") {
    for (const uint32_t first : {0u, 65500u, 0xffffff00u})
        for (const uint32_t block : {0u, 2u, 97u, 0x7fffffffu}) {
            constexpr uint32_t kPixels = 16, kSamples = 256;
            const Points points = draw({12345, first, block, kSeed}, kPixels, kSamples);
            for (uint32_t i = 0; i < points.size(); ++i) {
                const uint32_t sample = first + i % kSamples;
                const uint32_t pixel = 12345 + i / kSamples;
                const auto keys = reference::pixelKeys(pixel, kWidth, sample >> 16, block, kSeed);
                const Words twin = reference::pixelPoint(sample & 0xffffu, keys);
                REQUIRE(points[i] == glm::uvec4(twin[0], twin[1], twin[2], twin[3]));
            }
        }
}

TEST_CASE("the twin's sequence begins as published") {
    // Joe and Kuo's list for the first four dimensions, points 1 to 4 (their order is Gray's: 1, 3, 2, 6).
    const double expected[4][4] = {{0.5, 0.5, 0.5, 0.5},
                                   {0.75, 0.25, 0.25, 0.25},
                                   {0.25, 0.75, 0.75, 0.75},
                                   {0.375, 0.375, 0.625, 0.875}};
    const uint32_t numbers[4] = {1, 3, 2, 6};
    for (int i = 0; i < 4; ++i)
        for (int d = 0; d < 4; ++d) CHECK(reference::sobol(numbers[i], d) * 0x1p-32 == expected[i][d]);
}

// ---- strata ----

namespace {

// How many of the first 2^m points lie in each box of 2^-places[d] along each dimension; all of them hold as
// many, 2^(m - the sum of places).
bool fillsEvenly(const glm::uvec4* points, int m, const glm::ivec4& places) {
    const int sum = places.x + places.y + places.z + places.w;
    std::vector<uint32_t> counts(size_t{1} << sum);
    for (size_t i = 0; i < size_t{1} << m; ++i) {
        size_t box = 0;
        for (int d = 0; d < 4; ++d)
            box = box << places[d] | (places[d] > 0 ? points[i][d] >> (32 - places[d]) : 0u);
        counts[box]++;
    }
    for (const uint32_t count : counts)
        if (count != 1u << (m - sum)) return false;
    return true;
}

// A (t, m, 2)-net in these two dimensions.
bool isNet(const glm::uvec4* points, int m, int t, int a, int b) {
    for (int places = 0; places <= std::max(m - t, 0); ++places) {
        glm::ivec4 split(0);
        split[a] = places;
        split[b] = std::max(m - t, 0) - places;
        if (!fillsEvenly(points, m, split)) return false;
    }
    return true;
}

bool isFourDimensionalNet(const glm::uvec4* points, int m, int t) {
    const int places = m - t;
    for (int a = 0; a <= places; ++a)
        for (int b = 0; a + b <= places; ++b)
            for (int c = 0; a + b + c <= places; ++c)
                if (!fillsEvenly(points, m, {a, b, c, places - a - b - c})) return false;
    return true;
}

// t of each dimension alone: the degree of its polynomial less one (Sobol' 1967). Those of a pair add up.
constexpr int kT[] = {0, 0, 1, 2};

bool isSpread(const glm::uvec4* points, int most, const glm::ivec4& order = {0, 1, 2, 3}) {
    bool isSo = true;
    for (int m = 0; m <= most; ++m)
        for (int a = 0; a < 4; ++a)
            for (int b = a + 1; b < 4; ++b)
                isSo = isSo && isNet(points, m, kT[a] + kT[b], order[a], order[b]);
    return isSo;
}

} // namespace

TEST_CASE("the first 2^m points of a pixel fill every elementary interval of a pair of dimensions evenly") {
    constexpr uint32_t kSamples = 1024, kPixels = 16;
    for (const uint32_t first : {0u, 3072u, 0xfffff800u}) // any aligned stretch is as good as the first
        for (const uint32_t block : {0u, 1u, 5u}) {
            const Points points = draw({77, first, block, kSeed}, kPixels, kSamples);
            for (uint32_t p = 0; p < kPixels; ++p) {
                REQUIRE(isSpread(&points[p * kSamples], 10));
                REQUIRE(isFourDimensionalNet(&points[p * kSamples], 8, 3));
            }
        }
    const Points whole = draw({5, 0, 2, kSeed}, 1, kPoints);
    CHECK(isNet(whole.data(), 16, 0, 0, 1));
    CHECK(isSpread(whole.data(), 12));
}

TEST_CASE("a sample of 2^m x 2^m pixels in their place fills every elementary interval evenly") {
    for (const uint32_t sample : {0u, 5u, 65535u, 65536u}) {
        // The second tile of a picture that is one tile wide.
        const Points rows =
            draw({256, sample, 2, kSeed}, 256, 1, gpu::kSamplerBlock, gpu::kSamplerSobol, kTileSide);
        Points inOrder;
        for (uint32_t i = 0; i < 256; ++i) {
            uint32_t x = 0, y = 0;
            for (int k = 0; k < 4; ++k) {
                x |= (i >> (2 * k) & 1u) << k;
                y |= (i >> (2 * k + 1) & 1u) << k;
            }
            inOrder.push_back(rows[y * kTileSide + x]);
        }
        for (int m = 0; m <= 8; m += 2)
            for (uint32_t first = 0; first < 256; first += 1u << m) REQUIRE(isSpread(&inOrder[first], m));
        CHECK_FALSE(isSpread(rows.data(), 8)); // planted: row by row
    }
}

TEST_CASE("planted: random numbers and points out of place are not spread") {
    const Points random = draw({77, 0, 0, kSeed}, 1, 256, gpu::kSamplerBlock, gpu::kSamplerRandom);
    CHECK_FALSE(isSpread(random.data(), 4));
    Points points = draw({77, 0, 0, kSeed}, 1, 256);
    REQUIRE(isSpread(points.data(), 8));
    CHECK_FALSE(isSpread(points.data(), 8, {2, 1, 0, 3})); // as if the third dimension were the first
    points[100] = points[101];
    CHECK_FALSE(isSpread(points.data(), 8));
}

TEST_CASE("directions and points of lights get the first two dimensions") {
    for (const uint32_t depth : {0u, 1u, 7u}) {
        const Points bsdf = draw({9, 0, depth, kSeed}, 1, 256, gpu::kSamplerBsdf);
        CHECK(isSpread(bsdf.data(), 8, {1, 2, 0, 3})); // direction, lobe, roulette
        const Points light = draw({9, 0, depth, kSeed}, 1, 256, gpu::kSamplerLight);
        CHECK(isSpread(light.data(), 8, {2, 3, 0, 1})); // point, light, environment or not
    }
}

TEST_CASE("with random numbers every block is what it was") {
    for (const uint32_t which : {gpu::kSamplerBlock, gpu::kSamplerBsdf, gpu::kSamplerLight}) {
        const uint32_t depth = 4, block = which == gpu::kSamplerBlock  ? 4
                                          : which == gpu::kSamplerBsdf ? 2 + 3 * depth
                                                                       : 1 + 3 * depth;
        const Points points = draw({50, 7, 4, kSeed}, 8, 32, which, gpu::kSamplerRandom);
        for (uint32_t i = 0; i < points.size(); ++i) {
            const Words expected = reference::pcg4d({50 + i / 32, 7 + i % 32, block, kSeed});
            REQUIRE(points[i] == glm::uvec4(expected[0], expected[1], expected[2], expected[3]));
        }
    }
}

// ---- chance ----

namespace {

constexpr uint32_t kMany = 1u << 20;
constexpr uint32_t kUniformSamples[] = {0, 5, 65535, 65536, 0xffffffffu};
// Four dimensions and six pairs of each sample above fail together by chance once in a hundred times.
const double kLevel = reference::sidakLevel(0.01, 50);

double uniformPValue(const Points& points, const std::function<double(const glm::uvec4&)>& bin) {
    std::vector<double> counts(1024);
    for (const glm::uvec4& p : points) counts[static_cast<size_t>(bin(p))] += 1.0;
    const std::vector<double> expected(1024, double(points.size()) / 1024);
    return reference::chiSquareTest(counts, expected).pValue;
}

} // namespace

TEST_CASE("over pixels each sample is uniform, and so is each pair of its numbers") {
    for (const uint32_t sample : kUniformSamples) {
        const Points points = draw({0, sample, 2, kSeed}, kMany, 1);
        for (int a = 0; a < 4; ++a) {
            INFO("sample " << sample << ", dimension " << a);
            CHECK(uniformPValue(points, [&](const glm::uvec4& p) { return p[a] >> 22; }) > kLevel);
            for (int b = a + 1; b < 4; ++b) {
                INFO("and " << b);
                const auto square = [&](const glm::uvec4& p) { return (p[a] >> 27) << 5 | p[b] >> 27; };
                CHECK(uniformPValue(points, square) > kLevel);
            }
        }
    }
    Points points = draw({0, 5, 2, kSeed}, kMany, 1);
    for (size_t i = 0; i < points.size(); i += 20) points[i].x >>= 1; // planted: one in twenty is too small
    CHECK(uniformPValue(points, [](const glm::uvec4& p) { return p.x >> 22; }) < 1e-6);
}

namespace {

constexpr uint32_t kPixels = kWidth, kSamples = 32; // a row: 16 pixels of each tile

// Two sets of samples of the same pixels, as they would be combined in paths.
struct Correlation {
    double z = 0.0;      // of the mean product of what two numbers are off by from 1/2
    double spread = 0.0; // of a pixel's mean product: its square over that of independent numbers
};

Correlation correlate(const Points& a, const Points& b, int da, int db) {
    double sum = 0.0, squares = 0.0, tile = 0.0, tileSquares = 0.0;
    for (uint32_t p = 0; p < kPixels; ++p) {
        double mean = 0.0;
        for (uint32_t i = p * kSamples; i < (p + 1) * kSamples; ++i)
            mean += 12.0 * (unit(a[i][da]) - 0.5) * (unit(b[i][db]) - 0.5) / kSamples;
        sum += mean;
        squares += mean * mean;
        tile = p % kTileSide == 0 ? mean : tile + mean;
        if (p % kTileSide == kTileSide - 1) tileSquares += tile * tile;
    }
    return {sum / std::sqrt(tileSquares), squares / kPixels * kSamples};
}

// The sums of tiles are independent, so that theirs is normal. Spread: products of two numbers that are
// each even over stretches of 2^k samples vary in such stretches, and their means by more than those of
// independent numbers: by 1.58 if every node of both scrambles is a fair coin of its own (1.00 would take an
// order that is good for one number of samples alone).
constexpr double kMostSpread = 1.75;

struct Worst {
    double pValue = 1.0;
    double spread = 0.0;
    int tests = 0;

    void add(const Points& a, const Points& b) {
        for (int da = 0; da < 4; ++da)
            for (int db = 0; db < 4; ++db) {
                const Correlation c = correlate(a, b, da, db);
                pValue = std::min(pValue, reference::normalTwoSided(c.z));
                spread = std::max(spread, c.spread);
                ++tests;
            }
    }
    bool isIndependent() const { return pValue > reference::sidakLevel(0.01, tests) && spread < kMostSpread; }
};

Points block(uint32_t number, uint32_t pixel = 0, uint32_t sample = 0, uint32_t seed = kSeed) {
    return draw({pixel, sample, number, seed}, kPixels, kSamples);
}

} // namespace

TEST_CASE("blocks of a path, neighbouring tiles, seeds and groups of samples are independent") {
    Worst worst;
    std::vector<Points> blocks;
    for (const uint32_t number : {0u, 1u, 2u, 3u, 4u, 5u, 7u, 8u, 94u}) blocks.push_back(block(number));
    for (size_t a = 0; a < blocks.size(); ++a)
        for (size_t b = a + 1; b < blocks.size(); ++b) worst.add(blocks[a], blocks[b]);
    worst.add(blocks[2], block(2, kTileSide));
    worst.add(blocks[2], block(2, kTileSide * kWidth));
    worst.add(blocks[2], block(2, 0, 0, kSeed + 1));
    worst.add(blocks[2], block(2, 0, 65536));
    worst.add(blocks[2], draw({0, 0, 2, kSeed}, kPixels, kSamples, gpu::kSamplerBlock, gpu::kSamplerRandom));
    INFO(worst.tests << " pairs, p " << worst.pValue << ", spread " << worst.spread);
    CHECK(worst.isIndependent());
}

TEST_CASE("planted: one key or one order for two blocks, and a correlation of 0.02, are found") {
    const auto isFound = [](const Points& a, const Points& b) {
        Worst worst;
        worst.add(a, b);
        return !worst.isIndependent();
    };
    const Points one = block(1), two = block(2);
    REQUIRE_FALSE(isFound(one, two));
    CHECK(isFound(one, one));
    Points ordered = two; // other values in the order of the first
    for (uint32_t i = 0; i < ordered.size(); ++i) {
        auto keys = reference::pixelKeys(i / kSamples, kWidth, 0, 2, kSeed);
        keys.sequence.order = reference::pixelKeys(i / kSamples, kWidth, 0, 1, kSeed).sequence.order;
        const Words point = reference::pixelPoint(i % kSamples, keys);
        ordered[i] = {point[0], point[1], point[2], point[3]};
    }
    CHECK(isFound(one, ordered));
    Points mixed = two;
    for (size_t i = 0; i < mixed.size(); i += 50) mixed[i] = one[i];
    CHECK(isFound(one, mixed));
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(test::validatedDevice().validationMessages() == 0);
}
