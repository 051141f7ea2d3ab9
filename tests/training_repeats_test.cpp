// Training is a function of its records, bit for bit: again, with one thread or two, and across a file.
#include "tests/support/expect_error.h"
#include "tests/support/kernel_harness.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trainer_harness.h"
#include "tests/support/whole_model.h"
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>

using namespace irradia;
using namespace irradia::test;

namespace {

// With everything that a step can depend on.
ModelConfig fullModel(Precision precision = Precision::Float) {
    ModelConfig config = smallGridModel(R"({"otype": "Ema", "decay": 0.9, "nested": {
        "otype": "ExponentialDecay", "decay_start": 2, "decay_interval": 3, "decay_base": 0.5, "nested": {
        "otype": "Adam", "clip_norm": 0.3}}})");
    config.network.precision = precision;
    return config;
}

// Several batches a pass, so that their order counts.
void train(TrainerHarness& harness, int passes, uint64_t firstSeed = 1) {
    for (int pass = 0; pass < passes; ++pass)
        harness.train(randomQuads(1000, firstSeed + static_cast<uint64_t>(pass)), 4);
}

} // namespace

TEST_CASE("the same records give the same bits again") {
    for (const Precision precision : {Precision::Float, Precision::Half}) {
        TrainerHarness first(fullModel(precision)), again(fullModel(precision));
        for (TrainerHarness* harness : {&first, &again}) train(*harness, 3);
        CHECK(areSame(first.learned(), again.learned()));
    }
}

// Run by the next test in processes of their own.
TEST_CASE("a training that is saved", "[.saves]") {
    const char* file = std::getenv("IRRADIA_TEST_MODEL");
    REQUIRE(file);
    TrainerHarness harness(fullModel());
    train(harness, 3);
    harness.trainer().save(file);
}

TEST_CASE("one thread or two give the same file") {
    const TemporaryFolder folder;
    std::vector<std::vector<uint8_t>> files;
    for (const char* threads : {"1", "2", "2"}) {
        const std::string command = std::string("LP_NUM_THREADS=") + threads +
                                    " IRRADIA_TEST_MODEL=" + (folder / "model").string() +
                                    " " IRRADIA_BIN_DIR "/training_repeats_test '[.saves]' >/dev/null";
        REQUIRE(std::system(command.c_str()) == 0);
        files.push_back(folder.read("model"));
        std::filesystem::remove(folder / "model");
    }
    REQUIRE(files[0].size() > 1000);
    CHECK((files[0] == files[1]));
    CHECK((files[1] == files[2]));
}

TEST_CASE("a loaded model goes on as if it had never stopped") {
    const TemporaryFolder folder;
    TrainerHarness whole(fullModel(Precision::Half)), stopped(fullModel(Precision::Half));
    train(stopped, 2);
    stopped.trainer().save(folder / "model");
    CHECK(folder.entries() == 1);
    train(whole, 4);

    TrainerHarness loaded(fullModel(Precision::Half));
    train(loaded, 1, 77); // what it has learned so far goes
    const TrainingRecords queries = randomQuads(20, 5);
    const std::vector<double> before = loaded.predict(queries, Weights::Ema);
    loaded.trainer().load(folder / "model");
    CHECK(areSame(loaded.learned(), stopped.learned()));
    for (const Weights weights : {Weights::Ema, Weights::Raw})
        CHECK((loaded.predict(queries, weights) == stopped.predict(queries, weights)));
    CHECK((loaded.predict(queries, Weights::Ema) != before));
    train(loaded, 2, 3);
    CHECK(areSame(loaded.learned(), whole.learned()));
}

TEST_CASE("what its owner keeps beside a trainer comes back with it, or is missed by name") {
    const TemporaryFolder folder;
    TrainerHarness harness(smallModel());
    harness.train(randomQuads(100, 1));
    const std::vector<float> scale{0.25f, 3.0f};
    ModelFile model("cache");
    model.add<float>("cache state", scale);
    harness.trainer().save(folder / "a.model", std::move(model));

    TrainerHarness other(smallModel(), 2);
    const ModelFile back = ModelFile::read(folder / "a.model", "cache");
    CHECK(back.values<float>("cache state", 2) == scale);
    other.trainer().load(back);
    CHECK(areSame(other.learned(), harness.learned()));

    // A trainer alone does not read what depends on more than it.
    expectError(ExitCode::BadData, "a.model: is a model of kind 'cache', wanted is one of kind 'network'",
                [&] { other.trainer().load(folder / "a.model"); });
    // Nothing is changed where a block of the trainer's is missing.
    other.train(randomQuads(100, 2));
    const Learned before = other.learned();
    ModelFile partial("cache");
    partial.addText("shape", other.trainer().shapeName());
    partial.add<gpu::TrainingState>("counters", std::vector<gpu::TrainingState>(1));
    partial.add<float>("parameters", std::vector<float>(other.trainer().parameterCount()));
    expectError(ExitCode::BadData, "holds no block 'first moments'", [&] { other.trainer().load(partial); });
    CHECK(areSame(other.learned(), before));
}

TEST_CASE("a model of another shape, or none, is refused and changes nothing") {
    const TemporaryFolder folder;
    TrainerHarness harness(smallModel());
    harness.train(randomQuads(100, 1));
    const Learned before = harness.learned();
    const auto refused = [&](const ModelConfig& other, const std::string& named) {
        Trainer(validatedDevice(), other, kTrainerInputs, kTrainerOutputs, {256, 256, 1, {}})
            .save(folder / "other.model");
        const auto load = [&] { harness.trainer().load(folder / "other.model"); };
        expectError(ExitCode::BadData, "other.model: holds a model of FullyFusedMLP", load);
        expectError(ExitCode::BadData, named, load);
        expectError(ExitCode::BadData, harness.trainer().shapeName(), load);
        CHECK(areSame(harness.learned(), before));
    };
    ModelConfig wide = smallModel();
    wide.network.width = 32;
    refused(wide, "32x2");
    ModelConfig deep = smallModel();
    deep.network.hiddenLayers = 3;
    refused(deep, "16x3");
    ModelConfig exponential = smallModel();
    exponential.network.outputActivation = OutputActivation::Exponential;
    refused(exponential, "Exponential");
    refused(smallGridModel(), "DenseGrid");
    expectError(ExitCode::NotFound, "none.model", [&] { harness.trainer().load(folder / "none.model"); });

    // What is cut off is refused too, and what it held is not taken over by half.
    harness.trainer().save(folder / "own.model");
    std::vector<uint8_t> bytes = folder.read("own.model");
    bytes.resize(bytes.size() / 2);
    folder.write("own.model", bytes);
    harness.train(randomQuads(100, 2));
    const Learned now = harness.learned();
    expectError(ExitCode::BadData, "own.model: the model is cut off",
                [&] { harness.trainer().load(folder / "own.model"); });
    CHECK(areSame(harness.learned(), now));
}

TEST_CASE("a sparse grid's model is refused where as many other corners are stored") {
    const TemporaryFolder folder;
    ModelConfig config = smallModel();
    config.encoding = parseModelConfig(wholeModel(R"({"encoding": {"otype": "Composite", "nested": [
        {"otype": "SparseGrid", "n_dims_to_encode": 3, "n_levels": 2, "base_resolution": 4},
        {"otype": "Identity"}]}})"),
                                       "sparse model")
                          .encoding;
    const auto trainer = [&](float place) {
        return Trainer(validatedDevice(), config, kTrainerInputs, kTrainerOutputs,
                       {256, 256, 1, {{place, place, place}}});
    };
    const Trainer low = trainer(0.1f);
    Trainer high = trainer(0.9f), again = trainer(0.1f);
    REQUIRE(low.parameterCount() == high.parameterCount());
    low.save(folder / "low.model");
    CHECK_NOTHROW(again.load(folder / "low.model"));
    const std::vector<float> before = high.parameters(Weights::Raw);
    expectError(ExitCode::BadData, low.shapeName(), [&] { high.load(folder / "low.model"); });
    CHECK((high.parameters(Weights::Raw) == before));
}

TEST_CASE("precision is no part of the shape: weights are single") {
    const TemporaryFolder folder;
    TrainerHarness single(fullModel()), half(fullModel(Precision::Half));
    train(single, 1);
    single.trainer().save(folder / "model");
    half.trainer().load(folder / "model");
    CHECK(areSame(half.learned(), single.learned()));
}
