// Values that are no numbers, or far too large, in records and in what is learned: none stays, and each is
// counted.
#include "tests/reference/random.h"
#include "tests/support/kernel_harness.h"
#include "tests/support/network_comparison.h"
#include "tests/support/trainer_harness.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr double kBad[] = {NAN, INFINITY, -INFINITY, 1e30, -1e30};

ModelConfig inHalf(ModelConfig config) {
    config.network.precision = Precision::Half;
    return config;
}

// Every fifth record with a bad value: in turn each kind, at each place.
TrainingRecords withBadOnes(const TrainingRecords& good) {
    TrainingRecords mixed;
    size_t turn = 0;
    for (uint32_t i = 0; i < good.count(); ++i) {
        const std::vector<double> inputs = good.inputRow(i);
        const double* targets = &good.targets[size_t{i} * kTrainerOutputs];
        const auto append = [&] {
            mixed.inputs.insert(mixed.inputs.end(), inputs.begin(), inputs.end());
            mixed.targets.insert(mixed.targets.end(), targets, targets + kTrainerOutputs);
        };
        append();
        if (i % 5 != 0) continue;
        append();
        constexpr size_t kPlaces = kTrainerInputs + kTrainerOutputs;
        const size_t place = turn % kPlaces;
        (place < kTrainerInputs ? mixed.inputs.end()[-ptrdiff_t{kTrainerInputs} + ptrdiff_t(place)]
                                : mixed.targets.end()[-ptrdiff_t(kPlaces - place)]) =
            kBad[turn / kPlaces % std::size(kBad)];
        ++turn;
    }
    return mixed;
}

// Some of all places: of each matrix, of its padding, and of features.
std::vector<size_t> somePlaces(size_t count) {
    return {0, 17, 300, 16 * 16 + 16 * 16 + 2, 16 * 16 * 3 - 2, count - 1};
}

} // namespace

TEST_CASE("bad records are dropped and counted, and all others learned from") {
    const TrainingRecords good = randomQuads(200, 1), mixed = withBadOnes(good);
    REQUIRE(mixed.count() == 240);
    TrainerHarness harness;
    reference::Training twin = harness.twin();
    std::vector<reference::Values> inputs;
    for (uint32_t i = 0; i < good.count(); ++i) inputs.push_back(good.inputRow(i));
    for (uint32_t step = 1; step <= 3; ++step) {
        harness.train(mixed);
        twin.step(inputs, good.targets);
        CHECK(harness.trainer().counts().droppedRecords == 40 * step);
    }
    CHECK(worstError(doubles(harness.trainer().parameters(Weights::Raw)), twin.optimizer.parameters) <= 5e-6);
    CHECK(isFinite(harness.learned()));
}

TEST_CASE("no bad record leaves a trace in any model") {
    for (const ModelConfig& config :
         {smallModel(R"({"otype": "RelativeL2Luminance"})"), smallGridModel(), inHalf(smallGridModel())}) {
        TrainerHarness harness(config);
        for (int step = 0; step < 3; ++step) harness.train(withBadOnes(randomQuads(200, 2)), 2);
        const Learned learned = harness.learned();
        CHECK(isFinite(learned));
        CHECK(learned.state.droppedRecords == 3 * 40);
        CHECK(learned.state.steps == 6);
        CHECK(std::isfinite(learned.state.loss));
        CHECK(learned.state.damagedParameters == 0);
    }
}

TEST_CASE("bad weights are set to zero and counted, and training goes on") {
    const TrainingRecords records = randomQuads(100, 3);
    for (const ModelConfig& config : {smallModel(), smallModel(R"({"otype": "RelativeL2"})"),
                                      smallGridModel(), inHalf(smallGridModel())}) {
        TrainerHarness harness(config);
        uint32_t damaged = 0;
        for (const double bad : kBad) {
            std::vector<float> values = harness.trainer().parameters(Weights::Raw);
            const std::vector<size_t> places = somePlaces(values.size());
            for (const size_t i : places) values[i] = static_cast<float>(bad);
            harness.trainer().setParameters(values);
            harness.train(records);
            damaged += static_cast<uint32_t>(places.size());
            INFO(bad);
            CHECK(harness.trainer().counts().damagedParameters == damaged);
            CHECK(isFinite(harness.learned()));
            const uint32_t steps = harness.trainer().counts().steps;
            const uint32_t dropped = harness.trainer().counts().droppedRecords;
            harness.train(records);
            CHECK(harness.trainer().counts().steps == steps + 1);
            CHECK(harness.trainer().counts().droppedRecords == dropped);
            CHECK(harness.trainer().counts().damagedParameters == damaged);
        }
    }
}

TEST_CASE("bad moments and averages of a loaded model are set to zero and counted") {
    TrainerHarness harness(smallGridModel());
    harness.train(randomQuads(100, 4));
    Learned learned = harness.learned();
    learned.firstMoments[3] = NAN;
    learned.secondMoments[40] = INFINITY;
    learned.averages[500] = -INFINITY;
    learned.averages.back() = NAN;
    harness.setLearned(learned);
    harness.train(randomQuads(100, 5));
    CHECK(harness.trainer().counts().damagedParameters == 4);
    CHECK(isFinite(harness.learned()));
}

TEST_CASE("clipped steps are counted") {
    const TrainingRecords records = randomQuads(100, 6);
    const auto clippedOf = [&](const std::string& limit) {
        TrainerHarness harness(
            smallGridModel(R"({"otype": "Adam", "epsilon": 1e-3, "clip_norm": )" + limit + "}"));
        for (int step = 0; step < 4; ++step) harness.train(records, 2);
        return harness.trainer().counts().clippedSteps;
    };
    CHECK(clippedOf("0") == 0);
    CHECK(clippedOf("1e-4") == 8);
    CHECK(clippedOf("1e6") == 0);
}

// Where predictions begin near zero, bright targets make the gradients of a relative loss as large as they
// get: 2 t / 0.01.
TEST_CASE("bright targets are learned from in half precision too") {
    TrainingRecords records = randomQuads(100, 7);
    for (const double brightest : {30.0, 5e4}) {
        for (size_t i = 0; i < records.targets.size(); i += 7) records.targets[i] = brightest;
        for (const char* loss : {R"({"otype": "RelativeL2Luminance"})", R"({"otype": "L2"})"}) {
            TrainerHarness harness(inHalf(smallModel(loss)));
            std::vector<float> dark = harness.trainer().parameters(Weights::Raw);
            for (float& w : dark) w *= 0.1f;
            harness.trainer().setParameters(dark);
            harness.train(records);
            const Learned first = harness.learned();
            INFO("targets up to " << brightest << ", " << loss);
            CHECK(isFinite(first));
            CHECK(first.state.droppedRecords == 0);
            size_t moved = 0;
            for (size_t i = 0; i < dark.size(); ++i) moved += first.firstMoments[i] != 0.0f;
            CHECK(moved > 400); // of 560 that are used, some in neurons that no record wakes
        }
    }
}
