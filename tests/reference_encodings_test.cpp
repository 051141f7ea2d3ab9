// The reference's encodings and feature grids: closed forms, and derivatives by central differences.
#include "tests/reference/central_differences.h"
#include "tests/reference/encodings.h"
#include "tests/reference/feature_grid.h"
#include "tests/reference/quadrature.h"
#include "tests/reference/random.h"
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <numeric>

using namespace irradia::reference;
using Catch::Approx;

namespace {

std::vector<double> randomValues(Random& random, std::size_t count, double scale = 1.0) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(scale * (2.0 * random.uniform() - 1.0));
    return values;
}

double total(const Values& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

} // namespace

TEST_CASE("triangle has period 2, is even, linear between, and a cosine's signs") {
    CHECK(triangle(0.0) == 1.0);
    CHECK(triangle(0.5) == 0.0);
    CHECK(triangle(1.0) == -1.0);
    CHECK(triangle(-0.25) == 0.5);
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const double x = 20.0 * random.uniform() - 10.0;
        CHECK(std::abs(triangle(x + 2.0) - triangle(x)) < 1e-14);
        CHECK(std::abs(triangle(-x) - triangle(x)) < 1e-14);
        CHECK(std::abs(triangle(x) - (1.0 - 2.0 / kPi * std::acos(std::cos(kPi * x)))) < 1e-7);
    }
    const Values waves = triangleWave({0.1, 0.3}, 3);
    const Values expected{triangle(0.1), triangle(0.2), triangle(0.4),
                          triangle(0.3), triangle(0.6), triangle(1.2)};
    CHECK(waves == expected);
}

TEST_CASE("frequency holds sine and cosine of each octave, input after input") {
    const Values values = frequency({0.25, -0.1}, 2);
    const Values expected{
        std::sin(kPi / 4),    std::cos(kPi / 4),  1.0, 0.0, std::sin(-0.1 * kPi), std::cos(0.1 * kPi),
        std::sin(-0.2 * kPi), std::cos(0.2 * kPi)};
    REQUIRE(values.size() == expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) CHECK(std::abs(values[i] - expected[i]) < 1e-15);
    const Values high = frequency({1.0 / 3.0}, 16); // sin(2^15 pi / 3) = sin(2 pi / 3)
    CHECK(std::abs(high[30] - std::sin(2.0 * kPi / 3.0)) < 1e-11);
}

TEST_CASE("one-blob: integrals of the kernels, mass 1 within, symmetric") {
    const QuadratureRule rule = gaussLegendre(40);
    const auto gaussian = [](double u) { return std::exp(-0.5 * u * u) / std::sqrt(2.0 * kPi); };
    const auto quartic = [](double u) {
        return std::abs(u) < 1.0 ? 15.0 / 16.0 * (1 - u * u) * (1 - u * u) : 0.0;
    };
    for (const int bins : {1, 4, 7, 32})
        for (const double x : {0.0, 0.11, 0.5, 0.875, 1.0}) {
            CAPTURE(bins, x);
            const Values exact = oneBlobGaussian(x, bins), fast = oneBlobQuartic(x, bins);
            const Values exactMirrored = oneBlobGaussian(1.0 - x, bins),
                         fastMirrored = oneBlobQuartic(1.0 - x, bins);
            for (int i = 0; i < bins; ++i) {
                const auto at = static_cast<std::size_t>(i),
                           mirrored = static_cast<std::size_t>(bins - 1 - i);
                const double low = i - x * bins;
                CHECK(std::abs(exact[at] - rule.integrate(low, low + 1.0, gaussian)) < 1e-13);
                // The quartic kernel ends within a bin: integrate over what it covers.
                const double from = std::clamp(low, -1.0, 1.0), to = std::clamp(low + 1.0, -1.0, 1.0);
                CHECK(std::abs(fast[at] - rule.integrate(from, to, quartic)) < 1e-13);
                CHECK(std::abs(exact[at] - exactMirrored[mirrored]) < 1e-14);
                CHECK(std::abs(fast[at] - fastMirrored[mirrored]) < 1e-14);
            }
            CHECK(total(exact) == Approx(0.5 * (std::erf((1 - x) * bins / std::sqrt(2.0)) +
                                                std::erf(x * bins / std::sqrt(2.0)))));
            const bool isInside = x * bins >= 1.0 && (1.0 - x) * bins >= 1.0;
            if (isInside) CHECK(total(fast) == Approx(1.0).epsilon(1e-13));
            if (bins > 1 && (x == 0.0 || x == 1.0)) CHECK(total(fast) == Approx(0.5).epsilon(1e-13));
        }
    CHECK(total(oneBlobQuartic(1.5, 4)) == 0.0);
    CHECK(oneBlob({0.2, 0.7}, 4, false).size() == 8);
}

TEST_CASE("spherical harmonics are orthonormal and have the published signs") {
    const QuadratureRule rule = gaussLegendre(12);
    constexpr int kAzimuths = 16; // exact for products of bands below 8
    for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t j = 0; j < 16; ++j) {
            double integral = 0.0;
            for (int k = 0; k < kAzimuths; ++k)
                integral += rule.integrate(-1.0, 1.0, [&](double z) {
                    const Values y = sphericalHarmonics(direction(z, 2.0 * kPi * k / kAzimuths), 4);
                    return y[i] * y[j] * 2.0 * kPi / kAzimuths;
                });
            CHECK(std::abs(integral - (i == j ? 1.0 : 0.0)) < 1e-12);
        }
    const Vec3 w = glm::normalize(Vec3(0.3, -0.5, 0.7));
    // Sloan 2013: constants of the polynomials in x, y, z.
    const Values expected{0.28209479177387814,
                          -0.48860251190291987 * w.y,
                          0.48860251190291987 * w.z,
                          -0.48860251190291987 * w.x,
                          1.0925484305920792 * w.x * w.y,
                          -1.0925484305920792 * w.y * w.z,
                          0.94617469575755997 * w.z * w.z - 0.31539156525251999,
                          -1.0925484305920792 * w.x * w.z,
                          0.54627421529603959 * (w.x * w.x - w.y * w.y),
                          0.59004358992664352 * w.y * (w.y * w.y - 3.0 * w.x * w.x),
                          2.8906114426405538 * w.x * w.y * w.z,
                          0.45704579946446572 * w.y * (1.0 - 5.0 * w.z * w.z),
                          0.3731763325901154 * w.z * (5.0 * w.z * w.z - 3.0),
                          0.45704579946446572 * w.x * (1.0 - 5.0 * w.z * w.z),
                          1.4453057213202769 * w.z * (w.x * w.x - w.y * w.y),
                          0.59004358992664352 * w.x * (3.0 * w.y * w.y - w.x * w.x)};
    const Values y = sphericalHarmonics(w, 4);
    for (std::size_t i = 0; i < 16; ++i) CHECK(std::abs(y[i] - expected[i]) < 1e-15);
    CHECK(sphericalHarmonics(w, 1).size() == 1);
}

TEST_CASE("a composite's parts begin at multiples of four among ones") {
    const Values values = composite({{2, 3, 4}, {5, 6, 7, 8}, {9}});
    CHECK(values == Values{2, 3, 4, 1, 5, 6, 7, 8, 9, 1, 1, 1, 1, 1, 1, 1});
    CHECK(partOffsets({3, 4, 1}) == std::vector<std::size_t>{0, 4, 8});
    CHECK(composite({Values(16, 0.0)}).size() == 16);
    CHECK(composite({Values(17, 0.0)}).size() == 32);
}

namespace {

// Levels of tables of `tableSize` entries one after the other.
FeatureGrid makeGrid(std::size_t dims, uint64_t tableSize, bool mean) {
    FeatureGrid grid;
    grid.mean = mean;
    for (int l = 0; l < 3; ++l) {
        GridLevel level = gridLevel(l, 4, 1.5);
        level.firstEntry = static_cast<uint64_t>(l) * tableSize;
        level.entry = tableEntry(level.resolution, dims, tableSize);
        grid.levels.push_back(level);
    }
    return grid;
}

} // namespace

TEST_CASE("a dense grid interpolates linear functions of its corners exactly") {
    constexpr uint64_t kTable = 1000;
    Random random(2);
    for (const bool mean : {false, true}) {
        const FeatureGrid grid = makeGrid(3, kTable, mean);
        std::vector<double> features(3 * kTable * 2, 0.0);
        const auto linear = [](double x, double y, double z) { return 1.0 + x - 2.0 * y + 3.0 * z; };
        for (std::size_t l = 0; l < 3; ++l) {
            const uint32_t r = grid.levels[l].resolution;
            for (uint32_t i = 0; i < r * r * r; ++i)
                features[(l * kTable + i) * 2 + 1] = linear(i % r, i / r % r, i / (r * r));
        }
        for (int i = 0; i < 100; ++i) {
            const std::vector<double> x{0.8 * random.uniform(), 0.8 * random.uniform(),
                                        0.8 * random.uniform()};
            const std::vector<double> values = grid.encode(x, features);
            std::vector<double> expected;
            for (const GridLevel& level : grid.levels) {
                const double s = level.scale;
                expected.push_back(linear(x[0] * s + 0.5, x[1] * s + 0.5, x[2] * s + 0.5));
            }
            if (mean) expected = {total(expected) / 3.0};
            for (std::size_t l = 0; l < expected.size(); ++l) {
                CHECK(values[2 * l] == 0.0);
                CHECK(values[2 * l + 1] == Approx(expected[l]).epsilon(1e-12));
            }
        }
    }
}

TEST_CASE("resolutions, hashes and absent corners of grids") {
    CHECK(gridLevel(0, 16, 2.0).resolution == 16);
    CHECK(gridLevel(3, 16, 2.0).scale == 127.0);
    CHECK(gridLevel(1, 4, 1.6).resolution == 7); // 4 * 1.6 - 1 = 5.4
    CHECK(tableEntry(5, 3, 125)({1, 2, 3}) == 1 + 2 * 5 + 3 * 25);
    CHECK(tableEntry(5, 3, 125)({5, 0, 0}) == 5); // past the end of a row: the next row's first corner
    const uint32_t hash = 1u ^ (2u * 2654435761u) ^ (3u * 805459861u);
    CHECK(tableEntry(6, 3, 128)({1, 2, 3}) == hash % 128);
    CHECK(tableEntry(12, 2, 128)({1, 2}) == (1u ^ (2u * 2654435761u)) % 128);

    GridLevel level = gridLevel(0, 9, 2.0); // scale 8
    const auto dense = tableEntry(9, 2, 81);
    level.entry = [dense](const Corner& c) { return c[0] < 3 ? dense(c) : std::nullopt; };
    const auto weights = [&](double x) {
        double sum = 0.0;
        for (const GridCorner& corner : cornersAbout(level, {x, 0.4})) sum += corner.weight;
        return sum;
    };
    CHECK(weights(0.1) == Approx(1.0));       // cells 1 .. 2
    CHECK(weights(2.0 / 8.0) == Approx(0.5)); // half-way between 2 and 3
    CHECK(cornersAbout(level, {0.5, 0.4}).empty());
    CHECK(weights(-5.0) == Approx(weights(0.0)));
}

TEST_CASE("the gradient of a grid's features agrees with central differences") {
    Random random(3);
    for (const bool mean : {false, true})
        for (const uint64_t table : {uint64_t{64}, uint64_t{256}}) { // with collisions and without
            const FeatureGrid grid = makeGrid(2, table, mean);
            const std::vector<double> features = randomValues(random, 3 * table * 2);
            const std::vector<double> x{random.uniform(), random.uniform()};
            const std::vector<double> direction = randomValues(random, grid.width());
            std::vector<double> gradient(features.size(), 0.0);
            grid.addGradient(x, direction, gradient);
            const auto scalar = [&](const std::vector<double>& f) {
                return dot(grid.encode(x, f), direction);
            };
            CHECK(gradientError(scalar, features, gradient) < kGradientTolerance);
        }
}
