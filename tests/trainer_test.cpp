// Trainer: its steps against the double-precision twin, which records a pass uses, and which weights a
// prediction.
#include "engine/error.h"
#include "kernels/shaders.h"
#include "tests/reference/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/kernel_harness.h"
#include "tests/support/network_comparison.h"
#include "tests/support/trainer_harness.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <fmt/format.h>
#include <utility>

using namespace irradia;
using namespace irradia::test;

namespace {

// Relative to the largest value of the kind.
struct StepErrors {
    double loss = 0.0, values = 0.0, firstMoments = 0.0, secondMoments = 0.0, averages = 0.0;

    double worst() const { return std::max({loss, values, firstMoments, secondMoments, averages}); }
    std::string text() const {
        return fmt::format("loss {:.1e}, values {:.1e}, moments {:.1e} and {:.1e}, averages {:.1e}", loss,
                           values, firstMoments, secondMoments, averages);
    }
};

std::vector<reference::Values> inputRows(const TrainingRecords& records) {
    std::vector<reference::Values> rows;
    for (uint32_t row = 0; row < records.count(); ++row) rows.push_back(records.inputRow(row));
    return rows;
}

// After the twin's steps on the records.
StepErrors errorsAgainst(const Learned& learned, reference::Training twin, const TrainingRecords& records,
                         uint32_t steps) {
    double loss = 0.0;
    for (uint32_t step = 0; step < steps; ++step) loss = twin.step(inputRows(records), records.targets);
    return {std::abs(learned.state.loss - loss) / loss,
            worstError(doubles(learned.values), twin.optimizer.parameters),
            worstError(doubles(learned.firstMoments), twin.optimizer.first),
            worstError(doubles(learned.secondMoments), twin.optimizer.second),
            worstError(doubles(learned.averages), twin.optimizer.average.values)};
}

// Ten times the worst seen in single precision. Half: what each pass keeps is rounded as in the twin, but
// where sums differ in their last bits it may round the other way, by 2^-10 (five times the worst seen).
double tolerance(const ModelConfig& config) {
    return config.network.precision == Precision::Half ? 1e-2 : 5e-6;
}

constexpr const char* kEverything = R"({"otype": "Ema", "decay": 0.9, "nested": {"otype": "ExponentialDecay",
    "decay_start": 1, "decay_interval": 2, "decay_base": 0.5, "nested": {"otype": "Adam", "epsilon": 1e-3,
    "learning_rate": 0.02, "grid_learning_rate": 0.005, "l2_reg": 0.01, "clip_norm": 0.3}}})";

ModelConfig annealedModel() {
    return smallModel(R"({"otype": "RelativeL2Luminance", "exponent": [1, 0.2], "anneal": [1, 4]})",
                      kEverything);
}

ModelConfig halfModel() {
    ModelConfig model = smallModel(R"({"otype": "RelativeL2", "epsilon": 0.05})");
    model.network.precision = Precision::Half;
    model.optimizer.lossScale = 64.0;
    return model;
}

} // namespace

TEST_CASE("steps are those of the twin") {
    const TrainingRecords records = randomQuads(100, 1);
    const std::pair<const char*, ModelConfig> models[] = {
        {"L2", smallModel()},
        {"relative L2", smallModel(R"({"otype": "RelativeL2", "epsilon": 0.05})")},
        {"by luminance", smallModel(R"({"otype": "RelativeL2Luminance", "epsilon": 0.05})")},
        {"annealed, all of the optimiser", annealedModel()},
        {"grid, all of the optimiser", smallGridModel(kEverything)},
        {"half precision", halfModel()}};
    for (const auto& [name, config] : models) {
        TrainerHarness harness(config);
        const reference::Training twin = harness.twin();
        for (uint32_t step = 1; step <= 5; ++step) {
            harness.train(records);
            if (step != 1 && step != 2 && step != 5) continue;
            const StepErrors errors = errorsAgainst(harness.learned(), twin, records, step);
            INFO(name << ", step " << step << ": " << errors.text());
            CHECK(errors.worst() <= tolerance(config));
        }
        const TrainingCounts counts = harness.trainer().counts();
        CHECK(counts.steps == 5);
        CHECK(counts.droppedRecords == 0);
        CHECK(counts.damagedParameters == 0);
    }
    CHECK(validatedDevice().validationMessages() == 0);
}

TEST_CASE("a wrong step, loss or record is found") {
    const TrainingRecords records = randomQuads(100, 1);
    TrainerHarness harness(annealedModel());
    const reference::Training twin = harness.twin();
    constexpr uint32_t kSteps = 5;
    for (uint32_t step = 0; step < kSteps; ++step) harness.train(records);
    const Learned learned = harness.learned();
    const double limit = tolerance(annealedModel());
    REQUIRE(errorsAgainst(learned, twin, records, kSteps).worst() <= limit);

    const auto isFound = [&](const char* fault, auto plant) {
        INFO(fault);
        reference::Training wrong = twin;
        TrainingRecords used = records;
        plant(wrong, wrong.optimizer.settings, used);
        CHECK(errorsAgainst(learned, wrong, used, kSteps).worst() > 10.0 * limit);
    };
    using Twin = reference::Training;
    using Settings = reference::OptimizerSettings;
    using Used = TrainingRecords;
    isFound("beta1", [](Twin&, Settings& s, Used&) { s.beta1 = 0.91; });
    isFound("beta2", [](Twin&, Settings& s, Used&) { s.beta2 = 0.999; });
    isFound("learning rate 5 % off", [](Twin&, Settings& s, Used&) { s.learningRate *= 1.05; });
    isFound("no l2", [](Twin&, Settings& s, Used&) { s.l2 = 0.0; });
    isFound("decay a step late", [](Twin&, Settings& s, Used&) { s.decayStart = 2; });
    isFound("clip 2 % off", [](Twin&, Settings& s, Used&) { s.clipNorm *= 1.02; });
    isFound("average of another alpha", [](Twin& t, Settings&, Used&) { t.optimizer.average.decay = 0.92; });
    isFound("another epsilon of the loss", [](Twin& t, Settings&, Used&) { t.loss.epsilon = 0.02; });
    isFound("another loss", [](Twin& t, Settings&, Used&) { t.loss.type = reference::Loss::RelativeL2; });
    isFound("annealed a step late", [](Twin& t, Settings&, Used&) { t.annealEnd = 5; });
    isFound("a doubled record", [](Twin&, Settings&, Used& used) {
        used.inputs.insert(used.inputs.end(), used.inputs.begin(), used.inputs.begin() + kTrainerInputs);
        used.targets.insert(used.targets.end(), used.targets.begin(), used.targets.begin() + kTrainerOutputs);
    });
    isFound("a lost record", [](Twin&, Settings&, Used& used) {
        used.inputs.resize(used.inputs.size() - kTrainerInputs);
        used.targets.resize(used.targets.size() - kTrainerOutputs);
    });
    isFound("targets of neighbours",
            [](Twin&, Settings&, Used& used) { std::swap(used.targets[0], used.targets[3]); });
}

// Some records are spoilt, at random: the pass must count exactly those as dropped. Were a record used twice
// or not at all, each choice would miss it with a chance of a half at most.
TEST_CASE("a pass uses every record exactly once") {
    constexpr int kChoices = 10;
    TrainerHarness harness;
    reference::Random random(2);
    uint32_t spoilt = 0, steps = 0;
    for (const uint32_t count : {0u, 1u, kTrainerBatch - 1, kTrainerBatch, kTrainerBatch + 1})
        for (const uint32_t batches : {1u, 2u, 3u}) {
            if (count > batches * kTrainerBatch) continue;
            INFO(count << " records in " << batches << " batches");
            for (int choice = 0; choice < kChoices; ++choice) {
                TrainingRecords records = randomQuads(count, 3);
                for (uint32_t i = 0; i < count; ++i) {
                    if (random.uniform() < 0.5) continue;
                    records.targets[size_t{i} * kTrainerOutputs] = NAN;
                    ++spoilt;
                }
                harness.train(records, batches);
                REQUIRE(harness.trainer().counts().droppedRecords == spoilt);
            }
            const uint32_t before = std::exchange(steps, harness.trainer().counts().steps);
            // Of one record, or none, there is no more than that to learn from.
            if (count > 1) CHECK(steps - before == kChoices * batches);
            if (count <= 1) CHECK(steps - before <= count * kChoices);
        }
}

TEST_CASE("a pass without usable records changes nothing, bit for bit") {
    TrainerHarness harness(smallGridModel(kEverything));
    for (const bool trained : {false, true}) {
        if (trained)
            for (int i = 0; i < 3; ++i) harness.train(randomQuads(100, 4));
        const Learned before = harness.learned();
        harness.train(randomQuads(0, 5));
        harness.train(randomQuads(0, 5), 3);
        CHECK(areSame(harness.learned(), before));

        TrainingRecords unusable = randomQuads(10, 6);
        for (uint32_t i = 0; i < 10; ++i) unusable.targets[size_t{i} * kTrainerOutputs] = INFINITY;
        harness.train(unusable);
        Learned after = harness.learned();
        CHECK(after.state.droppedRecords == before.state.droppedRecords + 10);
        after.state.droppedRecords = before.state.droppedRecords;
        CHECK(areSame(after, before));
        after.averages[7] = std::nextafter(after.averages[7], 1.0f); // planted
        CHECK(!areSame(after, before));
    }
}

TEST_CASE("more effort is further passes, and the average follows faster") {
    const TrainingRecords records = randomQuads(200, 11);
    TrainerHarness once(annealedModel()), more(annealedModel()), twice(annealedModel());
    once.train(records, 2);
    twice.train(records, 2);
    twice.train(records, 2);
    more.train(records, 2, {.steps = 4});
    const auto weights = [](const TrainerHarness& h) { return h.trainer().parameters(Weights::Raw); };
    CHECK(more.trainer().counts().steps == 4);
    CHECK(weights(more) == weights(twice)); // each pass in an order of its own
    CHECK(weights(more) != weights(once));
    // The means are of the first pass alone.
    CHECK(more.trainer().counts().meanPrediction == once.trainer().counts().meanPrediction);
    CHECK(more.trainer().counts().meanPrediction != twice.trainer().counts().meanPrediction);

    TrainerHarness short3(annealedModel());
    short3.train(records, 2, {.steps = 3, .emaDecay = 0.0});
    CHECK(short3.trainer().counts().steps == 3);
    CHECK(weights(short3) == short3.trainer().parameters(Weights::Ema));
}

TEST_CASE("an effort's learning rate is a factor of the optimizer's") {
    const TrainingRecords records = randomQuads(200, 12);
    const auto weightsAfter = [&](double configured, double factor) {
        ModelConfig config = smallGridModel();
        config.optimizer.learningRate *= configured;
        config.optimizer.gridLearningRate *= configured;
        TrainerHarness harness(config);
        harness.train(records, 2, {.learningRate = factor});
        return harness.trainer().parameters(Weights::Raw);
    };
    CHECK(weightsAfter(1.0, 0.25) == weightsAfter(0.25, 1.0)); // powers of two round nothing
    CHECK(weightsAfter(1.0, 0.25) != weightsAfter(1.0, 1.0));
}

TEST_CASE("the means of predictions and targets are those of the usable records") {
    TrainingRecords records = randomQuads(201, 12);
    TrainerHarness harness;
    const std::vector<double> predictions = harness.predict(records, Weights::Raw);
    records.targets[0] = NAN;
    const auto luminance = [](const std::vector<double>& v, size_t row) {
        return 0.2126 * v[3 * row] + 0.7152 * v[3 * row + 1] + 0.0722 * v[3 * row + 2];
    };
    double prediction = 0.0, target = 0.0;
    for (size_t row = 1; row < 201; ++row) {
        prediction += luminance(predictions, row) / 200.0;
        target += luminance(records.targets, row) / 200.0;
    }
    harness.train(records);
    CHECK(std::abs(harness.trainer().counts().meanPrediction - prediction) <= 1e-5 * std::abs(prediction));
    CHECK(std::abs(harness.trainer().counts().meanTarget - target) <= 1e-5 * target);
    harness.train(records, 2); // of two batches: of one record more or less
    CHECK(std::abs(harness.trainer().counts().meanTarget - target) <= 1e-2 * target);
}

TEST_CASE("what pads the last quad of a record is not used") {
    const TrainingRecords records = randomQuads(100, 7);
    for (const ModelConfig& config : {smallModel(), annealedModel()}) {
        TrainerHarness clean(config, 1, 0.0), padded(config, 1, NAN);
        for (TrainerHarness* harness : {&clean, &padded}) harness->train(records, 2);
        CHECK(areSame(clean.learned(), padded.learned()));
        const bool agree = clean.predict(records, Weights::Raw) == padded.predict(records, Weights::Raw);
        CHECK(agree);
    }
}

// The harness' trainer predicts 512 rows together.
TEST_CASE("predictions use the weights asked for, as they are now, in parts where there are many rows") {
    const TrainingRecords records = randomQuads(1300, 8);
    TrainerHarness harness(smallGridModel(kEverything));
    const reference::Training twin = harness.twin();
    const auto isThatOf = [&](Weights weights) {
        const std::vector<double> parameters = doubles(harness.trainer().parameters(weights));
        std::vector<double> expected;
        for (const reference::Values& row : inputRows(records))
            for (const double value : twin.predict(parameters, row)) expected.push_back(value);
        return worstError(harness.predict(records, weights), expected) <=
               tolerance(harness.trainer().config());
    };
    const auto raw = [&] { return harness.trainer().parameters(Weights::Raw); };
    const auto ema = [&] { return harness.trainer().parameters(Weights::Ema); };
    CHECK(raw() == ema());
    for (int turn = 0; turn < 3; ++turn) {
        CHECK(isThatOf(Weights::Ema));
        CHECK(isThatOf(Weights::Raw));
        CHECK(isThatOf(Weights::Ema));
        harness.train(records, 6);
        CHECK(isThatOf(Weights::Ema));
        harness.train(records, 6);
        CHECK(isThatOf(Weights::Raw));
    }
    CHECK(raw() != ema());

    const std::vector<float> averages = ema();
    std::vector<float> halves = raw();
    for (float& v : halves) v *= 0.5f;
    harness.trainer().setParameters(halves);
    CHECK(raw() == halves);
    CHECK(ema() == averages);
    CHECK(isThatOf(Weights::Raw));
    CHECK(isThatOf(Weights::Ema));
}

TEST_CASE("passes that are declared and never executed change nothing") {
    const TrainingRecords records = randomQuads(256, 1);
    TrainerHarness harness(smallModel(R"({"otype": "L2"})", kEverything)),
        twin(smallModel(R"({"otype": "L2"})", kEverything));
    harness.train(records);
    twin.train(records);
    const Buffer counters = makeBuffer<uint32_t>(validatedDevice(), "counters", {256});
    const Buffer inputs(validatedDevice(), "inputs", 256 * 32),
        targets(validatedDevice(), "targets", 256 * 16);
    const Buffer results(validatedDevice(), "results", 256 * 16);
    const Kernel kernel(validatedDevice(), kernels::gpu_sizes);
    const RowCount rows{counters, 0, 256};
    const auto declare = [&](FrameGraph& graph, Weights weights) {
        harness.trainer().infer(graph, rows, inputs, results, weights);
        harness.trainer().train(graph, {rows, inputs, targets});
        harness.trainer().infer(graph, rows, inputs, results, weights);
    };
    for (const Weights weights : {Weights::Raw, Weights::Ema}) {
        {
            FrameGraph dropped(validatedDevice());
            declare(dropped, weights);
        }
        CHECK((harness.predict(records, weights) == twin.predict(records, weights)));
        FrameGraph failing(validatedDevice());
        declare(failing, weights);
        failing.pass(kernel); // never dispatched
        CHECK_THROWS_AS(failing.execute(), Error);
        CHECK((harness.predict(records, weights) == twin.predict(records, weights)));
    }
    CHECK(areSame(harness.learned(), twin.learned()));

    // Of two graphs that are declared together, each relies on what it does itself.
    FrameGraph first(validatedDevice()), second(validatedDevice());
    declare(first, Weights::Raw);
    harness.trainer().infer(second, rows, inputs, results, Weights::Raw);
    second.execute();
    CHECK((harness.predict(records, Weights::Raw) == twin.predict(records, Weights::Raw)));
    first.execute();
    TrainerHarness again(smallModel(R"({"otype": "L2"})", kEverything));
    again.setLearned(harness.learned());
    for (const Weights weights : {Weights::Raw, Weights::Ema})
        CHECK((harness.predict(records, weights) == again.predict(records, weights)));
}

TEST_CASE("a function is learned, and each pass shuffles anew") {
    TrainingRecords records = randomQuads(kTrainerBatch, 9);
    for (uint32_t i = 0; i < records.count(); ++i)
        for (uint32_t o = 0; o < kTrainerOutputs; ++o)
            records.targets[size_t{i} * kTrainerOutputs + o] = 0.5 + 0.4 * records.inputRow(i)[o];
    ModelConfig half = smallModel();
    half.network.precision = Precision::Half;
    for (const ModelConfig& config : {smallModel(), half}) {
        TrainerHarness harness(config);
        harness.train(records, 4);
        const float first = harness.trainer().counts().loss;
        for (int i = 0; i < 50; ++i) harness.train(records, 4);
        CHECK(harness.trainer().counts().loss < 0.01f * first);
        CHECK(harness.trainer().counts().steps == 204);
    }

    TrainerHarness other(smallModel(), 2);
    other.trainer().setParameters(TrainerHarness().trainer().parameters(Weights::Raw));
    TrainerHarness same;
    for (TrainerHarness* h : {&other, &same}) h->train(records, 4); // alike but for the shuffling's seed
    CHECK(!areSame(other.learned(), same.learned()));
}

TEST_CASE("more records than were planned are refused") {
    TrainerHarness harness;
    const TrainingRecords many = randomQuads(2 * kTrainerBatch + 1, 10);
    expectError(ExitCode::Internal, "768 records in 2 steps of at most 256", [&] { harness.train(many, 2); });
    expectError(ExitCode::Internal, "0 steps", [&] { harness.train(many, 0); });
    expectError(ExitCode::Internal, "3 parameters to set",
                [&] { harness.trainer().setParameters(std::vector<float>(3)); });
}
