// Losses of a batch and their gradients against the double-precision twin.
#include "nrc/learning/loss.h"
#include "nrc/learning/optimizer.h"
#include "tests/reference/losses.h"
#include "tests/reference/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/kernel_harness.h"
#include "tests/support/network_comparison.h"
#include "tests/support/network_rows.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr uint32_t kCapacity = 256;

struct LossBatch {
    uint32_t outputs = 3;
    std::vector<double> predictions, targets; // rows of `outputs`
    std::vector<uint32_t> usable;
    uint32_t count() const { return static_cast<uint32_t>(usable.size()); }
};

struct LossOutputs {
    std::vector<double> gradient; // rows of `outputs`, of the mean
    std::vector<double> padding;  // of the gradient's last quads
    std::vector<double> rowLoss;
    gpu::TrainingState state{};
};

// Predictions and targets of all signs and sizes, and some of exactly zero.
LossBatch randomBatch(uint32_t count, uint32_t outputs, uint64_t seed) {
    reference::Random random(seed);
    const auto value = [&] {
        const double size = std::pow(10.0, 6.0 * random.uniform() - 3.0);
        return random.uniform() < 0.1 ? 0.0 : stored(size * (random.uniform() - 0.3), Precision::Float);
    };
    LossBatch batch{outputs, {}, {}, std::vector<uint32_t>(count, 1)};
    for (uint32_t i = 0; i < count * outputs; ++i) {
        batch.predictions.push_back(value());
        batch.targets.push_back(value());
    }
    return batch;
}

// The state is of a training after `steps` steps. What pads the last quads, and rows that are not there, are
// no numbers.
LossOutputs evaluate(const LossConfig& config, const LossBatch& batch, uint32_t steps = 0,
                     float lossScale = 1.0f, float gradientLimit = gpu::kGradientLimit) {
    Device& device = validatedDevice();
    const RowFormat rows{batch.outputs};
    gpu::TrainingState state = Optimizer::initialState();
    state.steps = steps;
    state.batchRows = batch.count();
    state.loss = 77.0f;
    const Buffer states = makeBuffer(device, "state", std::vector{state});
    const Buffer results = rowBuffer(rows, kCapacity, batch.predictions, NAN);
    const Buffer targets = rowBuffer(rows, kCapacity, batch.targets, NAN);
    const Buffer usable = makeBuffer(device, "usable", batch.usable);
    const Buffer gradient = rowBuffer(rows, kCapacity, {}, 3.0);
    const Buffer rowSums(device, "row sums", kCapacity * sizeof(glm::vec4));
    const Loss loss(device, config, batch.outputs, lossScale, gradientLimit);
    FrameGraph graph(device);
    loss.evaluate(graph, kCapacity, states, results, targets, usable, gradient, rowSums);
    loss.endBatch(graph, states, rowSums);
    graph.execute();

    LossOutputs outputs;
    outputs.state = download<gpu::TrainingState>(device, states, 1).front();
    const RowFormat whole{4 * rows.quads()};
    const std::vector<double> all = downloadRows(gradient, whole, batch.count());
    for (size_t i = 0; i < all.size(); ++i)
        (i % whole.width < batch.outputs ? outputs.gradient : outputs.padding)
            .push_back(all[i] * outputs.state.gradientScale);
    for (const glm::vec4& sums : download<glm::vec4>(device, rowSums, batch.count()))
        outputs.rowLoss.push_back(sums.x);
    return outputs;
}

reference::LossSettings twinOf(const LossConfig& config, uint32_t steps) {
    const reference::Loss types[] = {reference::Loss::L2, reference::Loss::RelativeL2,
                                     reference::Loss::RelativeL2Luminance};
    return {types[static_cast<int>(config.type)], static_cast<float>(config.epsilon),
            reference::annealedExponent(config.exponentStart, config.exponentEnd, config.annealStart,
                                        config.annealEnd, steps)};
}

// Of single values, relative to each. The luminance of channels of both signs cancels (3e-6 is the worst
// seen), and the device's logarithm may err by 2^-21, times an exponent of at most 14.
constexpr double kTolerance = 1e-5;

double worstRelative(const std::vector<double>& actual, const std::vector<double>& expected) {
    if (actual.size() != expected.size()) return INFINITY;
    double worst = 0.0;
    for (size_t i = 0; i < actual.size(); ++i) {
        const double error = std::abs(actual[i] - expected[i]);
        worst = std::max(worst, error == 0.0 ? 0.0 : error / std::abs(expected[i]));
        if (std::isnan(error)) return INFINITY;
    }
    return worst;
}

// Of the gradient, and of the loss of each row and of the batch.
double worstError(const LossOutputs& outputs, const LossBatch& batch, const reference::LossSettings& twin) {
    const reference::LossValue value =
        reference::evaluateLoss(twin, batch.predictions, batch.targets, batch.outputs);
    std::vector<double> losses;
    for (size_t row = 0; row < batch.count(); ++row) {
        const auto part = [&](const std::vector<double>& all) {
            const auto begin = all.begin() + static_cast<ptrdiff_t>(row * batch.outputs);
            return std::vector<double>(begin, begin + batch.outputs);
        };
        losses.push_back(
            batch.outputs *
            reference::evaluateLoss(twin, part(batch.predictions), part(batch.targets), batch.outputs).mean);
    }
    return std::max({worstRelative(outputs.gradient, value.gradient), worstRelative(outputs.rowLoss, losses),
                     worstRelative({outputs.state.loss}, {value.mean})});
}

LossConfig configOf(LossType type, double exponentStart = 1.0, double exponentEnd = 1.0) {
    LossConfig config;
    config.type = type;
    config.epsilon = 0.02;
    config.exponentStart = exponentStart;
    config.exponentEnd = exponentEnd;
    config.annealStart = 10;
    config.annealEnd = 30;
    return config;
}

constexpr LossType kTypes[] = {LossType::L2, LossType::RelativeL2, LossType::RelativeL2Luminance};

} // namespace

TEST_CASE("losses and gradients are those of the twin") {
    for (const LossType type : kTypes)
        for (const uint32_t outputs : {1u, 3u, 4u, 16u}) {
            if (type == LossType::RelativeL2Luminance && outputs != 3) continue;
            INFO("loss " << static_cast<int>(type) << " of " << outputs << " outputs");
            const LossBatch batch = randomBatch(200, outputs, outputs);
            const LossConfig config = configOf(type);
            const LossOutputs got = evaluate(config, batch, 40);
            CHECK(worstError(got, batch, twinOf(config, 40)) <= kTolerance);
            CHECK(got.state.validRecords == 200);
            CHECK(got.state.droppedRecords == 0);
            // The network's backward pass takes whole quads.
            for (const double g : got.padding) CHECK(g == 0.0);
        }
    CHECK(validatedDevice().validationMessages() == 0);
}

TEST_CASE("the exponent goes from relative to plain") {
    const LossBatch batch = randomBatch(200, 3, 2);
    for (const LossType type : {LossType::RelativeL2, LossType::RelativeL2Luminance}) {
        const LossConfig config = configOf(type, 1.0, 0.0);
        for (const uint32_t step : {0u, 10u, 11u, 20u, 29u, 30u, 1000u}) {
            INFO("loss " << static_cast<int>(type) << ", step " << step);
            CHECK(worstError(evaluate(config, batch, step), batch, twinOf(config, step)) <= kTolerance);
        }
        CHECK(worstError(evaluate(config, batch, 30), batch, {reference::Loss::L2}) <= kTolerance);
        // Without a stretch of steps the end is all there is.
        LossConfig constant = configOf(type, 1.0, 0.5);
        constant.annealStart = constant.annealEnd = 0;
        CHECK(worstError(evaluate(constant, batch), batch, {twinOf(config, 0).type, 0.02f, 0.5}) <=
              kTolerance);
    }
}

TEST_CASE("a wrong denominator, gradient or step is found") {
    const LossBatch batch = randomBatch(200, 3, 3);
    const LossConfig config = configOf(LossType::RelativeL2Luminance, 1.0, 0.0);
    LossOutputs outputs = evaluate(config, batch, 20);
    const reference::LossSettings twin = twinOf(config, 20);
    REQUIRE(worstError(outputs, batch, twin) <= kTolerance);
    CHECK(worstError(outputs, batch, twinOf(config, 21)) > kTolerance);
    CHECK(worstError(outputs, batch, {reference::Loss::RelativeL2, twin.epsilon, twin.exponent}) >
          kTolerance);
    CHECK(worstError(outputs, batch, {twin.type, 1.01 * twin.epsilon, twin.exponent}) > kTolerance);
    outputs.gradient[7] *= 1.001;
    CHECK(worstError(outputs, batch, twin) > kTolerance);
}

TEST_CASE("a record that is left out counts for nothing") {
    for (const LossType type : kTypes) {
        LossBatch batch = randomBatch(100, 3, 4), kept = batch;
        kept.predictions.resize(size_t{80} * 3);
        kept.targets.resize(size_t{80} * 3);
        kept.usable.resize(80);
        for (size_t row = 80; row < 100; ++row) batch.usable[row] = 0;
        batch.predictions[80 * 3] = NAN; // what is left out may be anything
        LossOutputs outputs = evaluate(configOf(type), batch);
        CHECK(outputs.state.validRecords == 80);
        CHECK(outputs.state.droppedRecords == 0); // counted where it was found
        for (size_t i = size_t{80} * 3; i < size_t{100} * 3; ++i) CHECK(outputs.gradient[i] == 0.0);
        outputs.gradient.resize(size_t{80} * 3);
        outputs.rowLoss.resize(80);
        CHECK(worstError(outputs, kept, twinOf(configOf(type), 0)) <= kTolerance);
    }
}

TEST_CASE("a prediction that is no number, or whose loss is none, is dropped and counted") {
    for (const LossType type : kTypes)
        for (const double bad : {double(NAN), double(INFINITY), -double(INFINITY), 1e16, 1e20, -1e30, 3e38})
            for (const size_t output : {0u, 2u}) {
                INFO("loss " << static_cast<int>(type) << ", prediction " << bad);
                LossBatch batch = randomBatch(100, 3, 5), kept = batch;
                batch.predictions[99 * 3 + output] = bad;
                kept.predictions.resize(size_t{99} * 3);
                kept.targets.resize(size_t{99} * 3);
                kept.usable.resize(99);
                LossOutputs outputs = evaluate(configOf(type), batch);
                CHECK(outputs.state.droppedRecords == 1);
                CHECK(outputs.state.validRecords == 99);
                CHECK(outputs.rowLoss.back() == 0.0);
                outputs.gradient.resize(size_t{99} * 3);
                outputs.rowLoss.resize(99);
                CHECK(worstError(outputs, kept, twinOf(configOf(type), 0)) <= kTolerance);
            }
}

TEST_CASE("the loss of the last batch with records stays") {
    LossBatch batch = randomBatch(10, 3, 6);
    CHECK(evaluate(configOf(LossType::L2), batch).state.loss != 77.0f);
    batch.usable.assign(10, 0);
    CHECK(evaluate(configOf(LossType::L2), batch).state.loss == 77.0f);
    CHECK(evaluate(configOf(LossType::L2), {}).state.loss == 77.0f);
}

TEST_CASE("gradients are multiplied by the loss's scale, which the mean takes back") {
    const LossBatch batch = randomBatch(100, 3, 7);
    const LossOutputs plain = evaluate(configOf(LossType::RelativeL2), batch);
    const LossOutputs scaled = evaluate(configOf(LossType::RelativeL2), batch, 0, 128.0f);
    CHECK(scaled.state.gradientScale == plain.state.gradientScale / 128.0f);
    CHECK(scaled.gradient == plain.gradient); // powers of two: no rounding
    CHECK(scaled.rowLoss == plain.rowLoss);
}

TEST_CASE("scaled gradients are cut at their limit") {
    const LossBatch batch = randomBatch(100, 3, 8);
    const LossOutputs whole = evaluate(configOf(LossType::RelativeL2), batch);
    const LossOutputs cut = evaluate(configOf(LossType::RelativeL2), batch, 0, 4.0f, 16.0f);
    size_t larger = 0;
    for (size_t i = 0; i < cut.gradient.size(); ++i) {
        const double limit = 16.0 * cut.state.gradientScale;
        larger += std::abs(whole.gradient[i]) > limit;
        REQUIRE(cut.gradient[i] == std::clamp(whole.gradient[i], -limit, limit));
    }
    CHECK(larger > 10);
    CHECK(cut.rowLoss == whole.rowLoss);
}

TEST_CASE("a loss by luminance is of colours") {
    for (const uint32_t outputs : {1u, 2u, 4u})
        expectError(ExitCode::BadData, "RelativeL2Luminance needs the 3 outputs of a colour",
                    [&] { Loss(validatedDevice(), configOf(LossType::RelativeL2Luminance), outputs, 1.0f); });
}
