// The statistical tools themselves: known values of the distribution functions, tests that accept what is
// true at their level and refuse the planted faults.
#include "tests/reference/random.h"
#include "tests/reference/statistics.h"
#include "tests/reference/z_test.h"
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>

using namespace irradia::reference;
using Catch::Approx;

namespace {

// A picture of noise: mean `radiance` with a relative deviation of `sigma` in each pixel and channel.
ImageEstimate noisyImage(double radiance, double sigma, uint64_t seed) {
    ImageEstimate image{64, 64, {}, {}};
    Random random(seed);
    for (int i = 0; i < 64 * 64; ++i) {
        Vec3 deviate(0.0); // sum of 12 uniforms: variance 1
        for (int k = 0; k < 12; ++k)
            deviate += Vec3(random.uniform(), random.uniform(), random.uniform()) - 0.5;
        image.mean.push_back(radiance * (1.0 + sigma * deviate));
        image.variance.push_back(Vec3(radiance * sigma * radiance * sigma));
    }
    return image;
}

} // namespace

TEST_CASE("the incomplete gamma function has its known values") {
    for (const double x : {1e-3, 0.5, 1.0, 3.0, 20.0, 80.0}) {
        CHECK(upperGamma(1.0, x) == Approx(std::exp(-x)).epsilon(1e-12));
        CHECK(upperGamma(0.5, x) == Approx(std::erfc(std::sqrt(x))).epsilon(1e-12));
        CHECK(upperGamma(3.0, x) == Approx(std::exp(-x) * (1.0 + x + 0.5 * x * x)).epsilon(1e-12));
    }
    // Tables of the chi-square distribution: 5 % at 124.342 with 100 degrees of freedom.
    CHECK(upperGamma(50.0, 0.5 * 124.342) == Approx(0.05).epsilon(1e-4));
    CHECK(normalTwoSided(1.959963985) == Approx(0.05).epsilon(1e-8));
    CHECK(normalTwoSided(-2.575829304) == Approx(0.01).epsilon(1e-8));
    CHECK(sidakLevel(0.01, 1) == Approx(0.01));
    CHECK(std::pow(1.0 - sidakLevel(0.01, 4096), 4096.0) == Approx(0.99));
}

TEST_CASE("chi-square p-values are uniform where the hypothesis holds") {
    constexpr int kRounds = 2000, kBins = 20, kSamples = 1000;
    Random random(3);
    const std::vector<double> expected(kBins, static_cast<double>(kSamples) / kBins);
    std::vector<double> pValues(10, 0.0);
    for (int round = 0; round < kRounds; ++round) {
        std::vector<double> observed(kBins, 0.0);
        for (int i = 0; i < kSamples; ++i) observed[static_cast<size_t>(kBins * random.uniform())] += 1.0;
        const double p = chiSquareTest(observed, expected).pValue;
        pValues[std::min<size_t>(9, static_cast<size_t>(10.0 * p))] += 1.0;
    }
    const std::vector<double> uniform(10, kRounds / 10.0);
    CHECK(chiSquareTest(pValues, uniform).pValue > 1e-3);
}

TEST_CASE("chi-square merges thin bins and refuses the impossible") {
    const ChiSquareResult merged = chiSquareTest({3, 1, 2, 50, 44}, {2, 2, 2, 50, 44});
    CHECK(merged.degreesOfFreedom == 2);
    CHECK(merged.statistic == Approx(0.0));
    CHECK(chiSquareTest({1, 99}, {0, 100}).pValue == 0.0);
}

TEST_CASE("the z-test accepts equal pictures at its level and refuses every radiance off by 2 %") {
    constexpr double kSigma = 0.02; // what the comparisons of renderers ask of the median pixel
    constexpr uint64_t kPictures = 100;
    int refused = 0;
    for (uint64_t i = 0; i < kPictures; ++i) {
        const ImageEstimate reference = noisyImage(0.7, kSigma, 2 * i);
        refused += !zTest(noisyImage(0.7, kSigma, 2 * i + 1), reference).accepted();
        const ZTestResult fault = zTest(noisyImage(0.7 * 1.02, kSigma, 2 * i + 1), reference);
        CAPTURE(fault.summary());
        CHECK_FALSE(fault.accepted());
        CHECK(fault.meanRatio - 1.0 > 10.0 * fault.meanRatioSigma);
    }
    CHECK(refused <= 5); // 1 expected at alpha = 0.01, more than 5 with probability 5e-4
}

TEST_CASE("the z-test refuses a dozen wrong pixels and NaN, and sees rounding as nothing") {
    const ImageEstimate reference = noisyImage(0.7, 0.02, 1);
    ImageEstimate wrong = noisyImage(0.7, 0.02, 2);
    for (int i = 0; i < 12; ++i) wrong.mean[static_cast<size_t>(i) * 300] *= 1.5;
    CHECK(zTest(wrong, reference).acceptedPixels < 0.9975);
    ImageEstimate broken = noisyImage(0.7, 0.02, 2);
    for (int i = 0; i < 12; ++i) broken.mean[static_cast<size_t>(i) * 300].y = NAN;
    CHECK_FALSE(zTest(broken, reference).accepted());
    const ImageEstimate constant = noisyImage(17.0, 0.0, 1),
                        rounded = noisyImage(17.0 * (1.0 + 1e-5), 0.0, 1);
    CHECK(zTest(rounded, constant).accepted());
    CHECK_FALSE(zTest(noisyImage(17.0 * 1.002, 0.0, 1), constant).accepted());
}
