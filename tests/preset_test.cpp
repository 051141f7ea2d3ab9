// Presets and models that inherit by name: what is inherited, what is replaced, what is missed and by which
// words.
#include "nrc/renderer/nrc_config.h"
#include "tests/support/expect_error.h"
#include <catch2/catch_test_macros.hpp>
#include <limits>
#include <nlohmann/json.hpp>

using namespace irradia;
using irradia::test::expectError;
using Json = nlohmann::json;

namespace {

NrcConfig parse(const std::string& json) {
    return parseNrcConfig(json, "own.json");
}

// What stands in the preset's model, but for the encoding that all of them differ in.
ModelConfig withEncodingOf(ModelConfig model, const ModelConfig& other) {
    model.encoding = other.encoding;
    return model;
}

} // namespace

TEST_CASE("every preset is whole, and comes back from its JSON") {
    REQUIRE(nrcPresetNames().size() >= 4);
    for (const std::string& name : nrcPresetNames()) {
        INFO(name);
        const NrcConfig preset = nrcPreset(name);
        const std::string text = toJson(preset);
        CHECK(parse(text) == preset);
        CHECK(toJson(parse(text)) == text);
        CHECK(parse(R"({"base": ")" + name + "\"}") == preset);
        CHECK(Json::parse(text).contains("base") == false);
    }
    expectError(ExitCode::Usage, "there is no preset slow; there are balanced, faithful",
                [] { nrcPreset("slow"); });
}

// The values that were measured, whichever file they stand in.
TEST_CASE("presets that inherit are what they were in full") {
    const NrcConfig balanced = nrcPreset("balanced"), fast = nrcPreset("fast"),
                    lambert = nrcPreset("lambert");
    NrcConfig expected = balanced;
    expected.unbiasedShare = 0.5f;
    expected.minRecords = 2048;
    expected.steps = 2;
    expected.model.encoding[0].keys["n_levels"] = 4;
    expected.model.encoding[0].keys["per_level_scale"] = 2;
    expected.model.network.width = 16;
    expected.model.optimizer.learningRate = expected.model.optimizer.gridLearningRate = 0.01;
    CHECK(fast == expected);
    CHECK(lambert.model.encoding.size() == 4);
    CHECK(withEncodingOf(lambert.model, balanced.model) == balanced.model);
    CHECK(nrcPreset("faithful").adaptation.settling == 0);
    CHECK(nrcPreset("faithful").unbiasedShare == 0.0625f);
}

TEST_CASE("every knob comes back from its JSON") {
    NrcConfig config = parse(R"({"base": "faithful", "paths": {"spread": "never", "training_spread": 0.1,
        "end_depth": 3, "unbiased_share": 0.3, "suffix_bounces": 5, "residual_share": 0.7},
        "training": {"records": 1000, "min_records": 7, "steps": 3, "self_training": "Raw", "uniform_share": 0.05},
        "adaptation": "off", "factorise": "off", "shown": "Raw"})");
    CHECK(config.spread == std::numeric_limits<float>::infinity());
    CHECK(config.trainingSpread == 0.1f);
    CHECK_FALSE(config.adaptation.on);
    CHECK(parse(toJson(config)) == config);
    // Numbers in single precision are written as one would write them.
    CHECK(Json::parse(toJson(config))["paths"]["training_spread"].dump() == "0.1");
}

TEST_CASE("what is given changes the base, and nothing else") {
    NrcConfig expected = nrcPreset("balanced");
    expected.spread = expected.trainingSpread = 0.02f; // follows where nobody gives it
    expected.adaptation.youth = 64;
    expected.model.optimizer.learningRate = expected.model.optimizer.gridLearningRate = 0.25;
    CHECK(parse(R"({"base": "balanced", "paths": {"spread": 0.02}, "adaptation": {"youth": 64},
        "model": {"optimizer": {"nested": {"learning_rate": 0.25}}}})") == expected);

    // Lists and what is of another type replace: nothing of the base's hash grid or Ema is left.
    const NrcConfig replaced = parse(R"({"base": "balanced", "model": {
        "encoding": {"otype": "OneBlob", "n_bins": 8},
        "loss": {"otype": "L2"},
        "optimizer": {"otype": "Adam", "learning_rate": 0.1, "beta1": 0.5, "beta2": 0.5, "epsilon": 1e-8,
                      "l2_reg": 0}}})");
    REQUIRE(replaced.model.encoding.size() == 1);
    CHECK(replaced.model.encoding[0].whole("n_bins") == 8);
    CHECK(replaced.model.loss == LossConfig{});
    CHECK(replaced.model.optimizer.emaDecay == 0);
    CHECK(replaced.model.network == nrcPreset("balanced").model.network);
    const NrcConfig parts = parse(R"({"base": "balanced", "model": {"encoding": {"nested": [
        {"otype": "Identity"}]}}})");
    CHECK(parts.model.encoding.size() == 1);
}

TEST_CASE("a model inherits that of a preset") {
    ModelConfig expected = nrcPreset("faithful").model;
    expected.network.width = 32;
    const std::string own = R"("network": {"n_neurons": 32}})";
    CHECK(parseCacheModel(R"({"base": "faithful", )" + own, "model.json") == expected);
    CHECK(parseCacheModel(toJson(expected), "model.json") == expected);
    expectError(ExitCode::BadData, "model.json: encoding is missing, and no \"base\" names a preset",
                [&] { parseCacheModel("{" + own, "model.json"); });
    expectError(ExitCode::BadData,
                "model.json: base must be one of balanced, faithful, fast, lambert, not \"b\"",
                [] { parseCacheModel(R"({"base": "b"})", "model.json"); });
    // A preset of its own is a preset, not a model.
    expectError(ExitCode::BadData, "model.json: unknown key paths",
                [] { parseCacheModel(R"({"base": "fast", "paths": {}})", "model.json"); });
}

TEST_CASE("without a base every key that decides is missed by name") {
    const Json whole = Json::parse(toJson(nrcPreset("balanced")));
    for (const auto& [section, value] : whole.items()) {
        Json without = whole;
        without.erase(section);
        expectError(ExitCode::BadData, "own.json: " + section + " is missing, and no \"base\"",
                    [&] { parse(without.dump()); });
    }
    size_t missed = 0;
    for (const std::string section : {"paths", "training", "adaptation"})
        for (const auto& [key, value] : whole[section].items()) {
            Json without = whole;
            without[section].erase(key);
            if (key == "training_spread" || key == "residual_share" || key == "uniform_share") {
                CHECK(parse(without.dump()) == nrcPreset("balanced"));
                continue;
            }
            ++missed;
            expectError(ExitCode::BadData, "own.json: " + section + "." + key + " is missing, it must be",
                        [&] { parse(without.dump()); });
        }
    CHECK(missed == 15); // 3 of paths, 4 of training, 8 of adaptation
    Json model = whole;
    model["model"]["network"].erase("n_neurons");
    expectError(ExitCode::BadData, "own.json: model.network.n_neurons is missing",
                [&] { parse(model.dump()); });
}

TEST_CASE("a base that is none is refused") {
    for (const char* base : {"3", "null", "\"slow\"", "[\"fast\"]", "{}"})
        expectError(ExitCode::BadData, "own.json: base must be one of balanced",
                    [&] { parse(std::string(R"({"base": )") + base + "}"); });
    expectError(ExitCode::BadData, "own.json: unknown key bass",
                [] { parse(R"({"base": "fast", "bass": 1})"); });
    expectError(ExitCode::BadData, "own.json: the file must be an object", [] { parse("[]"); });
}
