// The reference's network, losses and optimiser: closed forms, and derivatives by central differences.
#include "tests/reference/central_differences.h"
#include "tests/reference/half.h"
#include "tests/reference/losses.h"
#include "tests/reference/network.h"
#include "tests/reference/optimizers.h"
#include "tests/reference/permutation.h"
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

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

} // namespace

TEST_CASE("halves round to nearest and even, and come back from their bits") {
    for (uint32_t bits = 0; bits < 0x10000; ++bits) {
        const double value = halfFromBits(static_cast<uint16_t>(bits));
        if (std::isnan(value)) continue;
        REQUIRE(roundToHalf(value) == value);
        REQUIRE(halfBits(value) == bits);
    }
    CHECK(roundToHalf(1.0 + 0x1p-11) == 1.0); // ties
    CHECK(roundToHalf(1.0 + 3 * 0x1p-11) == 1.0 + 0x1p-9);
    CHECK(roundToHalf(1.0 + 0x1.2p-11) == 1.0 + 0x1p-10);
    CHECK(roundToHalf(0x1p-25) == 0.0);
    CHECK(roundToHalf(0x1.8p-25) == 0x1p-24);
    CHECK(roundToHalf(65519.0) == kHalfMax);
    CHECK(std::isinf(roundToHalf(65520.0)));
}

TEST_CASE("a network of one neuron by hand") {
    Mlp mlp{2, 1, 2, 1};
    mlp.storedOutputs = 1;
    REQUIRE(mlp.weightCount() == 4);
    const auto run = [&](const std::vector<double>& weights) {
        return mlp.forward(weights, {3.0, 1.0}).results[0];
    };
    CHECK(run({2, -1, 0.5, 4}) == 10.0); // 4 relu(0.5 relu(2 * 3 - 1))
    CHECK(run({-2, -1, 0.5, 4}) == 0.0);
    mlp.output = Activation::Exponential;
    CHECK(run({2, -1, 0.5, 4}) == Approx(std::exp(10.0)));
    CHECK(run({2, -1, 0.5, 40}) == Approx(std::exp(30.0)));
    mlp.output = Activation::Softplus;
    CHECK(run({2, -1, 0.5, 0}) == Approx(std::log(2.0)));
    CHECK(run({2, -1, 0.5, 4000}) == Approx(10000.0));
    mlp.output = Activation::ReLU;
    CHECK(run({2, -1, 0.5, -4}) == 0.0);
}

TEST_CASE("what is kept between passes can be rounded") {
    Mlp mlp{1, 1, 1, 1};
    mlp.storedOutputs = 1;
    mlp.store = [](double x) { return std::round(x); };
    const std::vector<double> weights{0.4, 0.4};
    const auto resultOf = [&] { return mlp.forward(weights, {3.5}).results[0]; }; // 0.4 relu(0.4 * 3.5)
    const auto gradientOf = [&] {
        std::vector<double> gradient(2, 0.0);
        gradient.push_back(mlp.backward(weights, mlp.forward(weights, {3.5}), {5.6}, gradient)[0]);
        return gradient;
    };
    CHECK(resultOf() == Approx(0.4));
    CHECK(gradientOf() == std::vector<double>{7.0, 6.0, 1.0}); // 5.6 is kept as 6, then 2.4 as 2
    mlp.handsOnStored = false;
    CHECK(resultOf() == Approx(0.56));
    CHECK(gradientOf() == std::vector<double>{7.0, 6.0, 1.0}); // 2.24 as 2, then 0.896 as 1
}

TEST_CASE("the gradients of a network agree with central differences") {
    Random random(4);
    for (const Activation output :
         {Activation::None, Activation::ReLU, Activation::Exponential, Activation::Softplus})
        for (const std::size_t hidden : {1u, 2u, 4u}) {
            const Mlp mlp{16, 8, hidden, 3, output};
            const std::vector<double> weights = randomValues(random, mlp.weightCount(), 0.7);
            std::vector<double> input = randomValues(random, mlp.inputs);
            // A difference across a kink is none of the derivative: keep away from it.
            while (mlp.forward(weights, input).margin < 1e-3) input = randomValues(random, mlp.inputs);
            const std::vector<double> direction = randomValues(random, mlp.outputs);
            std::vector<double> gradient(weights.size(), 0.0);
            const std::vector<double> inputGradient =
                mlp.backward(weights, mlp.forward(weights, input), direction, gradient);
            CAPTURE(static_cast<int>(output), hidden);
            const auto ofWeights = [&](const std::vector<double>& w) {
                return dot(mlp.forward(w, input).results, direction);
            };
            const auto ofInput = [&](const std::vector<double>& x) {
                return dot(mlp.forward(weights, x).results, direction);
            };
            CHECK(gradientError(ofWeights, weights, gradient) < kGradientTolerance);
            CHECK(gradientError(ofInput, input, inputGradient) < kGradientTolerance);
            gradient[5] *= 1.0 + 1e-4; // planted
            gradient[5] += 1e-4;
            CHECK(gradientError(ofWeights, weights, gradient) > kGradientTolerance);
        }
}

TEST_CASE("the gradients of losses agree with central differences at a constant denominator") {
    Random random(5);
    for (const Loss type : {Loss::L2, Loss::RelativeL2, Loss::RelativeL2Luminance})
        for (const double exponent : {0.0, 0.4, 1.0}) {
            const LossSettings loss{type, 0.01, exponent};
            const std::vector<double> predictions = randomValues(random, 12),
                                      targets = randomValues(random, 12);
            const auto mean = [&](const std::vector<double>& p) {
                return evaluateLoss(loss, p, targets, 3, predictions).mean;
            };
            const LossValue value = evaluateLoss(loss, predictions, targets, 3);
            CHECK(gradientError(mean, predictions, value.gradient) < kGradientTolerance);
            if (exponent == 0.0) {
                CHECK(value.mean == Approx(evaluateLoss({Loss::L2}, predictions, targets, 3).mean));
                continue;
            }
            // Through the denominator as well the derivative is another.
            const auto attached = [&](const std::vector<double>& p) {
                return evaluateLoss(loss, p, targets, 3).mean;
            };
            if (type != Loss::L2) CHECK(gradientError(attached, predictions, value.gradient) > 1e-3);
        }
}

TEST_CASE("losses by hand") {
    CHECK(evaluateLoss({Loss::L2}, {1, 2, 3}, {1, 1, 1}, 3).mean == Approx(5.0 / 3.0));
    CHECK(evaluateLoss({Loss::RelativeL2, 1.0}, {1, 2, 3}, {0, 0, 0}, 3).mean ==
          Approx((0.5 + 0.8 + 0.9) / 3.0));
    const double y = 0.2126 * 1 + 0.7152 * 2 + 0.0722 * 3;
    CHECK(evaluateLoss({Loss::RelativeL2Luminance, 0.5}, {1, 2, 3}, {0, 0, 0}, 3).mean ==
          Approx(14.0 / 3.0 / (y * y + 0.5)));
    CHECK(evaluateLoss({Loss::L2}, {1, 2}, {0, 0}, 1).gradient == std::vector<double>{1.0, 2.0});
    CHECK(annealedExponent(1.0, 0.0, 10, 20, 5) == 1.0);
    CHECK(annealedExponent(1.0, 0.0, 10, 20, 15) == 0.5);
    CHECK(annealedExponent(1.0, 0.0, 10, 20, 25) == 0.0);
    CHECK(annealedExponent(1.0, 0.25, 0, 0, 0) == 0.25);
}

TEST_CASE("Adam's first steps by hand, and its bound") {
    OptimizerSettings settings;
    settings.epsilon = 0.0;
    Optimizer adam{settings, 1, {1.0}};
    adam.step({0.3}); // m-hat / sqrt(v-hat) = 1 whatever the gradient
    CHECK(adam.parameters[0] == Approx(1.0 - 0.01));
    adam.step({-0.1});
    const double m = (0.9 * 0.1 * 0.3 - 0.1 * 0.1) / (1 - 0.81),
                 v = (0.99 * 0.01 * 0.09 + 0.01 * 0.01) / (1 - 0.9801);
    CHECK(adam.parameters[0] == Approx(0.99 - 0.01 * m / std::sqrt(v)));

    settings.l2 = 0.5; // alone it pulls towards zero
    Optimizer regularised{settings, 1, {1.0, 1.0}};
    regularised.step({0.0, 0.0});
    CHECK(regularised.parameters[0] == Approx(0.99));
    CHECK(regularised.parameters[1] == 1.0); // a feature: neither l2 nor a step without gradient
    CHECK(regularised.second[1] == 0.0);
}

TEST_CASE("the learning rate decays at the multiples of its interval up to its end") {
    OptimizerSettings s;
    s.decayBase = 0.5;
    s.decayStart = 10;
    s.decayInterval = 5;
    s.decayEnd = 20;
    for (const auto& [t, factor] :
         {std::pair{0u, 1.0}, {9u, 1.0}, {10u, 0.5}, {14u, 0.5}, {15u, 0.25}, {20u, 0.125}, {99u, 0.125}})
        CHECK(learningRateFactor(s, t) == factor);
    s.decayInterval = 0;
    CHECK(learningRateFactor(s, 50) == 1.0);
}

TEST_CASE("a long gradient is clipped to its limit, a short one stays") {
    std::vector<double> gradient{3.0, 4.0};
    CHECK_FALSE(clipNorm(gradient, 0.0));
    CHECK_FALSE(clipNorm(gradient, 5.0));
    CHECK(gradient == std::vector<double>{3.0, 4.0});
    CHECK(clipNorm(gradient, 0.5));
    CHECK(gradient[0] == Approx(0.3));
    CHECK(gradient[1] == Approx(0.4));
}

TEST_CASE("the moving average is its closed form, and not the recursion without eta") {
    Random random(6);
    for (const double decay : {0.0, 0.5, 0.99}) {
        MovingAverage average{decay};
        std::vector<double> history;
        double inconsistent = 0.0; // (1 - a) / eta_t W_t + a eta_(t-1) W-bar_(t-1)
        for (int t = 1; t <= 200; ++t) {
            history.push_back(5.0 + random.uniform());
            average.add({history.back()});
            inconsistent = (1.0 - decay) / (1.0 - std::pow(decay, t)) * history.back() +
                           decay * (1.0 - std::pow(decay, t - 1)) * inconsistent;
            CHECK(average.values[0] == Approx(movingAverage(decay, history)).epsilon(1e-12));
            if (decay > 0.0 && t == 5) CHECK(std::abs(inconsistent - average.values[0]) > 0.1);
        }
        if (decay == 0.0) CHECK(average.values[0] == history.back());
    }
    CHECK(movingAverage(0.5, {1.0, 4.0}) == Approx((0.5 * 1.0 + 4.0) / 1.5));
}

TEST_CASE("a permutation, and what is none") {
    CHECK(isPermutation({}));
    CHECK(isPermutation({2, 0, 1}));
    CHECK_FALSE(isPermutation({2, 0, 2}));
    CHECK_FALSE(isPermutation({1, 2, 3}));
}
