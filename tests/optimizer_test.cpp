// Optimizer: Adam, its average, decay and clip against the double-precision twin, on gradients that are
// given.
#include "nrc/learning/optimizer.h"
#include "tests/reference/optimizers.h"
#include "tests/reference/random.h"
#include "tests/support/gpu_rounding.h"
#include "tests/support/gradient_sums.h"
#include "tests/support/kernel_harness.h"
#include "tests/support/network_comparison.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <fmt/format.h>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr uint32_t kWeights = 3000, kFeatures = 1000; // more than one workgroup's share of the norm
constexpr uint32_t kAll = kWeights + kFeatures;

// Weights and features with their optimiser; vectors hold the weights first.
class OptimizerHarness {
public:
    explicit OptimizerHarness(const OptimizerConfig& config,
                              bool byAddress = validatedDevice().storesByAddress())
        : config_(config)
        , weights_(validatedDevice(), "weights", kWeights, config.learningRate, config.l2,
                   GradientForm::Floats)
        , features_(validatedDevice(), "features", kFeatures, config.gridLearningRate, 0.0,
                    GradientForm::Sums)
        , optimizer_(validatedDevice(), config, byAddress)
        , state_(makeBuffer(validatedDevice(), "state", std::vector{Optimizer::initialState()})) {}

    using Part = Buffer ParameterGroup::*;
    void set(Part part, const std::vector<float>& values) {
        upload<float>(validatedDevice(), weights_.*part, std::span(values).first(kWeights));
        upload<float>(validatedDevice(), features_.*part, std::span(values).subspan(kWeights));
    }
    std::vector<float> get(Part part) const {
        auto values = download<float>(validatedDevice(), weights_.*part, kWeights);
        const auto rest = download<float>(validatedDevice(), features_.*part, kFeatures);
        values.insert(values.end(), rest.begin(), rest.end());
        return values;
    }

    // Of a batch with this many records, of which so many are usable. The features' sums are zero then.
    void step(const std::vector<float>& gradient, uint32_t records = 1, uint32_t usable = 1,
              uint32_t times = 1, std::optional<double> emaDecay = {}) {
        const std::span<const float> ofWeights = std::span(gradient).first(kWeights),
                                     ofFeatures = std::span(gradient).subspan(kWeights);
        upload<float>(validatedDevice(), weights_.gradients, ofWeights);
        gpu::TrainingState now = state();
        now.batchRows = records;
        now.validRecords = usable;
        now.gradientScale = finestScale(ofFeatures);
        const Buffer sums = makeBuffer(validatedDevice(), "sums", sumsOf(ofFeatures, now.gradientScale));
        upload<gpu::TrainingState>(validatedDevice(), state_, std::span(&now, 1));
        const ParameterGroup* groups[] = {&weights_, &features_};
        FrameGraph graph(validatedDevice());
        for (uint32_t i = 0; i < times; ++i) {
            graph.copy(sums, features_.gradients);
            optimizer_.step(graph, state_, groups, emaDecay);
        }
        graph.execute();
        const auto left = download<int32_t>(validatedDevice(), features_.gradients, 2 * kFeatures);
        if (records > 0) REQUIRE(left == std::vector<int32_t>(2 * kFeatures, 0));
    }
    gpu::TrainingState state() const {
        return download<gpu::TrainingState>(validatedDevice(), state_, 1).front();
    }

    reference::Optimizer twin() const {
        const auto single = [](double value) { return double(static_cast<float>(value)); };
        const std::vector<float> values = get(&ParameterGroup::values);
        return {{single(config_.learningRate), single(config_.gridLearningRate), single(config_.beta1),
                 single(config_.beta2), single(config_.epsilon), single(config_.l2), single(config_.emaDecay),
                 config_.decayStart, config_.decayInterval, config_.decayEnd, single(config_.decayBase),
                 single(config_.clipNorm)},
                kWeights,
                {values.begin(), values.end()}};
    }

private:
    // Of sums whose largest has 62 bits: so fine that floats are kept whole, nearly all.
    static float finestScale(std::span<const float> gradients) {
        float largest = 1e-30f;
        for (const float g : gradients) largest = std::max(largest, std::abs(g));
        return std::ldexp(gpu::kGradientUnits, std::ilogb(largest) - 61);
    }

    OptimizerConfig config_;
    ParameterGroup weights_, features_;
    Optimizer optimizer_;
    Buffer state_;
};

constexpr OptimizerHarness::Part kParts[] = {&ParameterGroup::values, &ParameterGroup::firstMoments,
                                             &ParameterGroup::secondMoments, &ParameterGroup::averages};

std::vector<float> randomFloats(reference::Random& random, float size) {
    std::vector<float> values;
    for (uint32_t i = 0; i < kAll; ++i)
        values.push_back(size * static_cast<float>(2.0 * random.uniform() - 1.0));
    return values;
}

// From 1e-6 to 10, a third exactly zero.
std::vector<float> randomGradient(reference::Random& random) {
    std::vector<float> gradient = randomFloats(random, 10.0f);
    for (float& g : gradient)
        g *=
            random.uniform() < 1.0 / 3.0 ? 0.0f : static_cast<float>(std::pow(10.0, -6.0 * random.uniform()));
    return gradient;
}

std::vector<double> doubles(const std::vector<float>& values) {
    return {values.begin(), values.end()};
}

// Relative to the largest of the kind.
double errorAgainst(const OptimizerHarness& harness, const reference::Optimizer& twin) {
    return std::max({worstError(doubles(harness.get(&ParameterGroup::values)), twin.parameters),
                     worstError(doubles(harness.get(&ParameterGroup::firstMoments)), twin.first),
                     worstError(doubles(harness.get(&ParameterGroup::secondMoments)), twin.second),
                     worstError(doubles(harness.get(&ParameterGroup::averages)), twin.average.values)});
}
// A step rounds each value a few times by 2^-24; ten times the worst seen on a CPU.
double tolerance() {
    return test::divisionSlack() * 2e-6;
}

OptimizerConfig plainConfig() {
    OptimizerConfig config;
    config.l2 = 0.0;
    return config;
}

OptimizerConfig fullConfig() {
    OptimizerConfig config;
    config.learningRate = 0.02;
    config.gridLearningRate = 0.1;
    config.l2 = 0.05;
    config.emaDecay = 0.95;
    config.decayStart = 1;
    config.decayInterval = 2;
    config.decayEnd = 4;
    config.decayBase = 0.3;
    config.clipNorm = 120.0;
    return config;
}

struct NamedConfig {
    const char* name;
    OptimizerConfig config;
};

std::vector<NamedConfig> configs() {
    std::vector<NamedConfig> all{{"plain", plainConfig()}, {"all", fullConfig()}};
    const auto add = [&](const char* name, auto change) {
        all.push_back({name, plainConfig()});
        change(all.back().config);
    };
    add("l2", [](OptimizerConfig& c) { c.l2 = 0.1; });
    add("rates", [](OptimizerConfig& c) { c.gridLearningRate = 0.3; });
    add("decay", [](OptimizerConfig& c) {
        c.decayStart = 2;
        c.decayInterval = 1;
        c.decayEnd = 3;
        c.decayBase = 0.1;
    });
    add("average", [](OptimizerConfig& c) { c.emaDecay = 0.99; });
    add("clip", [](OptimizerConfig& c) { c.clipNorm = 1.0; });
    add("betas", [](OptimizerConfig& c) {
        c.beta1 = 0.0;
        c.beta2 = 0.0;
    });
    return all;
}

} // namespace

TEST_CASE("steps are those of the twin") {
    for (const auto& [name, config] : configs()) {
        reference::Random random(1);
        OptimizerHarness harness(config);
        harness.set(&ParameterGroup::values, randomFloats(random, 1.0f));
        reference::Optimizer twin = harness.twin();
        for (uint32_t step = 1; step <= 6; ++step) {
            std::vector<float> gradient = randomGradient(random);
            if (step % 2 == 0)
                for (float& g : gradient) g *= 3.0f; // so that some steps are clipped and some are not
            harness.step(gradient);
            twin.step(doubles(gradient));
            INFO(name << ", step " << step);
            CHECK(errorAgainst(harness, twin) <= tolerance());
        }
        CHECK(harness.state().steps == 6);
        CHECK(harness.state().clippedSteps == twin.clippedSteps);
        if (std::string_view(name) == "all") CHECK((twin.clippedSteps > 0 && twin.clippedSteps < 6));
        CHECK(harness.state().damagedParameters == 0);
    }
    CHECK(validatedDevice().validationMessages() == 0);
}

TEST_CASE("stored through bindings, parameters have the bits of those stored by address") {
    reference::Random random(13);
    const std::vector<float> values = randomFloats(random, 1.0f);
    OptimizerHarness plain(fullConfig(), false), own(fullConfig());
    for (OptimizerHarness* harness : {&plain, &own}) harness->set(&ParameterGroup::values, values);
    for (int step = 0; step < 3; ++step) {
        const std::vector<float> gradient = randomGradient(random);
        plain.step(gradient);
        own.step(gradient);
    }
    for (const auto part : kParts) CHECK((plain.get(part) == own.get(part)));
}

TEST_CASE("a wrong setting or gradient is found") {
    const auto errorWith = [](auto plant) {
        reference::Random random(2);
        OptimizerHarness harness(fullConfig());
        harness.set(&ParameterGroup::values, randomFloats(random, 1.0f));
        reference::Optimizer twin = harness.twin();
        for (int step = 0; step < 3; ++step) {
            std::vector<float> gradient = randomGradient(random);
            if (step == 1)
                for (float& g : gradient) g *= 3.0f; // is clipped
            harness.step(gradient);
            std::vector<double> used = doubles(gradient);
            plant(twin, used);
            twin.step(used);
        }
        return errorAgainst(harness, twin);
    };
    using Twin = reference::Optimizer;
    using Gradient = std::vector<double>;
    REQUIRE(errorWith([](Twin&, Gradient&) {}) <= tolerance());
    const auto isFound = [&](const char* fault, auto plant) {
        INFO(fault);
        CHECK(errorWith(plant) > 10.0 * tolerance());
    };
    isFound("beta1", [](Twin& t, Gradient&) { t.settings.beta1 = 0.91; });
    isFound("beta2", [](Twin& t, Gradient&) { t.settings.beta2 = 0.999; });
    isFound("learning rate 5 % off", [](Twin& t, Gradient&) { t.settings.learningRate = 0.021; });
    isFound("grid's rate 5 % off", [](Twin& t, Gradient&) { t.settings.featureLearningRate = 0.105; });
    isFound("l2", [](Twin& t, Gradient&) { t.settings.l2 = 0.0; });
    isFound("l2 of features as well", [](Twin& t, Gradient&) { t.networkWeights = kAll; });
    isFound("no decay", [](Twin& t, Gradient&) { t.settings.decayInterval = 0; });
    isFound("no clip", [](Twin& t, Gradient&) { t.settings.clipNorm = 0.0; });
    isFound("average", [](Twin& t, Gradient&) { t.average.decay = 0.96; });
    isFound("a doubled derivative", [](Twin&, Gradient& g) { g[3] = 2.0 * g[3] + 1.0; });
}

TEST_CASE("averages are their closed form") {
    constexpr uint32_t kSteps = 40;
    for (const double decay : {0.0, 0.5, 0.99}) {
        OptimizerConfig config = plainConfig();
        config.learningRate = config.gridLearningRate = 0.0; // parameters change where the test says
        config.emaDecay = decay;
        OptimizerHarness harness(config);
        reference::Random random(3);
        const std::vector<float> before = randomFloats(random, 1.0f), after = randomFloats(random, 1.0f);
        const std::vector<float> gradient(kAll, 1.0f);
        const auto expect = [&](auto value) {
            std::vector<double> expected;
            for (uint32_t i = 0; i < kAll; ++i) expected.push_back(value(before[i], after[i]));
            INFO("alpha " << decay << ", step " << harness.state().steps);
            CHECK(worstError(doubles(harness.get(&ParameterGroup::averages)), expected) <= tolerance());
        };
        const double alpha = static_cast<float>(decay);
        // What stands there before the first step is replaced by it.
        harness.set(&ParameterGroup::averages, std::vector<float>(kAll, 1000.0f));
        harness.set(&ParameterGroup::values, before);
        for (const uint32_t steps : {1u, 1u, kSteps - 2}) {
            harness.step(gradient, 1, 1, steps);
            expect([](double constant, double) { return constant; });
        }
        // A change at step s: at step t the new value has weight (1 - a^(t - s)) / (1 - a^t).
        harness.set(&ParameterGroup::values, after);
        uint32_t since = 0;
        for (const uint32_t steps : {1u, 9u, 90u}) {
            harness.step(gradient, 1, 1, steps);
            since += steps;
            const double share = (1.0 - std::pow(alpha, since)) / (1.0 - std::pow(alpha, since + kSteps));
            expect([&](double old, double now) { return old + share * (now - old); });
        }
        if (decay == 0.0) CHECK(harness.get(&ParameterGroup::averages) == after);
    }
}

// Average of W_1 .. W_t: weights (1 - a_i) a_(i+1) .. a_t over their sum.
TEST_CASE("an average whose decay changes is its closed form, without bias") {
    reference::Random random(12);
    OptimizerConfig config = plainConfig();
    config.emaDecay = 0.99;
    OptimizerHarness harness(config);
    harness.set(&ParameterGroup::values, randomFloats(random, 1.0f));
    std::vector<std::vector<float>> history;
    std::vector<double> decays;
    for (const double decay : {0.99, 0.99, 0.5, 0.9, 0.0, 0.99, 0.999, 0.7, 0.99}) {
        harness.step(randomGradient(random), 1, 1, 1, decay);
        history.push_back(harness.get(&ParameterGroup::values));
        decays.push_back(static_cast<float>(decay));
        std::vector<double> expected(kAll, 0.0);
        double sum = 0.0, later = 1.0; // a_(i+1) .. a_t
        for (size_t i = history.size(); i > 0; --i) {
            const double weight = (1.0 - decays[i - 1]) * later;
            for (uint32_t p = 0; p < kAll; ++p) expected[p] += weight * history[i - 1][p];
            sum += weight;
            later *= decays[i - 1];
        }
        for (double& value : expected) value /= sum;
        const double error = worstError(doubles(harness.get(&ParameterGroup::averages)), expected);
        INFO(history.size() << " steps, error " << error);
        CHECK(error <= tolerance());
        CHECK(std::abs(harness.state().etaEma - sum) <= 1e-6);
    }
}

TEST_CASE("bias corrections stay exact over many steps") {
    // Under a constant gradient each step is the learning rate, in closed form, from the first on. So many
    // sums round by 2^-24 of the parameter each.
    constexpr uint32_t kSteps = 300;
    OptimizerConfig config = plainConfig();
    config.learningRate = config.gridLearningRate = 1e-3;
    config.beta2 = 0.999;
    OptimizerHarness harness(config);
    harness.step(std::vector<float>(kAll, 0.25f), 1, 1, kSteps);
    for (const float v : harness.get(&ParameterGroup::values)) REQUIRE(std::abs(v + 1e-3 * kSteps) <= 1e-5);
}

TEST_CASE("a gradient whose square vanishes makes no large step") {
    OptimizerConfig config = plainConfig();
    config.epsilon = 1e-18; // the least that models may ask for
    config.beta2 = 0.999;
    OptimizerHarness harness(config);
    std::vector<float> gradient(kAll);
    for (uint32_t i = 0; i < kAll; ++i)
        gradient[i] = static_cast<float>(std::pow(10.0, -15.0 - 10.0 * i / kAll)); // to 1e-25
    gradient[0] = 0.0f;
    harness.step(gradient);
    for (const float v : harness.get(&ParameterGroup::values))
        REQUIRE(std::abs(v) <= 5.0 * config.learningRate);
    CHECK(harness.get(&ParameterGroup::values)[0] == 0.0f);
    CHECK(harness.state().damagedParameters == 0);
}

TEST_CASE("a batch without usable records changes nothing, bit for bit") {
    OptimizerHarness harness(fullConfig());
    reference::Random random(4);
    harness.set(&ParameterGroup::values, randomFloats(random, 1.0f));
    harness.step(randomGradient(random), 1, 1, 3);
    for (const uint32_t records : {0u, 5u}) {
        std::vector<std::vector<float>> before;
        for (const auto part : kParts) before.push_back(harness.get(part));
        const gpu::TrainingState stateBefore = harness.state();
        harness.step(randomGradient(random), records, 0);
        for (size_t i = 0; i < std::size(kParts); ++i) CHECK((harness.get(kParts[i]) == before[i]));
        const gpu::TrainingState state = harness.state();
        CHECK(state.steps == stateBefore.steps);
        CHECK(state.clippedSteps == stateBefore.clippedSteps);
        CHECK(state.learningRateFactor == stateBefore.learningRateFactor);
        CHECK(state.eta1 == stateBefore.eta1);
        CHECK(state.eta2 == stateBefore.eta2);
        CHECK(state.etaEma == stateBefore.etaEma);
    }
}

TEST_CASE("a parameter with anything that is no number becomes zero, and is counted") {
    for (const auto part : kParts)
        for (const float bad : {NAN, INFINITY, -INFINITY, 2e30f}) {
            OptimizerHarness harness(fullConfig());
            reference::Random random(5);
            harness.set(&ParameterGroup::values, randomFloats(random, 1.0f));
            harness.step(randomGradient(random), 1, 1, 2);
            std::vector<float> values = harness.get(part);
            for (const uint32_t i : {0u, 1u, 1030u, kWeights - 1, kWeights, kAll - 1}) values[i] = bad;
            harness.set(part, values);
            const std::vector<float> untouched = harness.get(&ParameterGroup::values);
            INFO("part " << (part == kParts[0] ? 0 : 1) << ", " << bad);

            harness.step(randomGradient(random), 1, 0); // no record is needed for it
            CHECK(harness.state().damagedParameters == 6);
            CHECK(harness.get(&ParameterGroup::values)[2] == untouched[2]);
            for (const auto all : kParts) CHECK(harness.get(all)[1030] == 0.0f);
            harness.step(randomGradient(random));
            CHECK(harness.state().damagedParameters == 6);
            for (const auto all : kParts)
                for (const float v : harness.get(all)) REQUIRE(std::isfinite(v));
        }
}

TEST_CASE("a derivative that is no number leaves its parameter and the norm alone") {
    for (const float bad : {NAN, INFINITY, -INFINITY, 1e30f}) {
        OptimizerConfig config = fullConfig();
        config.l2 = 0.0;
        OptimizerHarness harness(config);
        reference::Random random(6);
        harness.set(&ParameterGroup::values, randomFloats(random, 1.0f));
        reference::Optimizer twin = harness.twin();
        for (int step = 0; step < 3; ++step) {
            std::vector<float> gradient = randomGradient(random);
            for (const uint32_t i : {9u, kWeights - 1})
                gradient[i] = 0.0f; // at which a weight without moments stays
            const std::vector<double> used = doubles(gradient);
            for (const uint32_t i : {9u, kWeights - 1}) gradient[i] = bad;
            harness.step(gradient);
            twin.step(used);
        }
        INFO(bad);
        CHECK(errorAgainst(harness, twin) <= tolerance());
        CHECK(harness.state().damagedParameters == 0);
        CHECK(harness.state().clippedSteps == twin.clippedSteps);

        const float before = harness.get(&ParameterGroup::values)[8]; // which has moments
        std::vector<float> gradient = randomGradient(random);
        gradient[8] = bad;
        harness.step(gradient);
        CHECK(harness.get(&ParameterGroup::values)[8] == before);
    }
}

TEST_CASE("clipped is what is longer than the limit") {
    OptimizerConfig config = plainConfig();
    config.beta1 = 0.0; // the first moment is the gradient that is used
    config.clipNorm = 2.0;
    std::vector<float> gradient(kAll, 0.0f);
    const auto lengthUsed = [&](OptimizerHarness& harness) {
        double squares = 0.0;
        for (const float g : harness.get(&ParameterGroup::firstMoments)) squares += double(g) * g;
        return std::sqrt(squares);
    };
    for (const auto& [weight, feature, length, clipped] : {std::tuple{1.19f, 1.6f, 1.994, 0u},
                                                           {1.2f, 1.61f, 2.0, 1u},
                                                           {0.0f, 3.0f, 2.0, 1u},
                                                           {9e14f, 9e14f, 2.0, 1u},
                                                           {0.0f, 0.0f, 0.0, 0u}}) {
        OptimizerHarness harness(config);
        gradient[5] = weight;
        gradient[kWeights + 7] = feature;
        harness.step(gradient);
        CHECK(harness.state().clippedSteps == clipped);
        CHECK(std::abs(lengthUsed(harness) - length) < 1e-3);
    }
}
