// A model's JSON: what is read, what is refused with which words, and that hostile files are refused too.
#include "nrc/config.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"
#include <catch2/catch_test_macros.hpp>
#include <cstring>

using namespace irradia;
using irradia::test::expectError;
using irradia::test::TemporaryFolder;

namespace {

ModelConfig parse(const std::string& json) {
    return parseModelConfig(json, "model.json");
}

// Refused in one sentence that names the file and says `words`.
void checkRefused(const std::string& json, const std::string& words) {
    INFO((json.size() < 300 ? json : json.substr(0, 300) + "..."));
    expectError(ExitCode::BadData, "model.json: ", [&] { parse(json); });
    expectError(ExitCode::BadData, words, [&] { parse(json); });
}

// The paper's encoding of position, direction, normal and roughness (Müller 2021, table 2).
constexpr const char* kPaper = R"({
  "encoding": {"otype": "Composite", "nested": [
    {"n_dims_to_encode": 3, "otype": "TriangleWave", "n_frequencies": 12},
    {"n_dims_to_encode": 5, "otype": "OneBlob", "n_bins": 4, "kernel": "Gaussian"},
    {"otype": "Identity", "scale": 0.5, "offset": -1}
  ]},
  "network": {"otype": "FullyFusedMLP", "activation": "ReLU", "output_activation": "Exponential",
              "n_neurons": 128, "n_hidden_layers": 4, "precision": "Half", "form": "Workgroup"},
  "loss": {"otype": "RelativeL2Luminance", "epsilon": 0.02, "exponent": [1, 0.5], "anneal": [100, 2000]},
  "optimizer": {"otype": "Ema", "decay": 0.99, "nested": {
    "otype": "ExponentialDecay", "decay_start": 10, "decay_interval": 5, "decay_end": 90, "decay_base": 0.33,
    "nested": {"otype": "Adam", "learning_rate": 0.001, "beta1": 0.8, "beta2": 0.999, "epsilon": 1e-15,
               "l2_reg": 0, "clip_norm": 1.5, "loss_scale": 1024}}}
})";

std::string nested(size_t depth, const std::string& open, const std::string& close) {
    std::string text;
    for (size_t i = 0; i < depth; ++i) text += open;
    text += "1";
    for (size_t i = 0; i < depth; ++i) text += close;
    return text;
}

} // namespace

TEST_CASE("every key is read") {
    const ModelConfig config = parse(kPaper);
    REQUIRE(config.encoding.size() == 3);
    CHECK(config.encoding[0].type == EncodingType::TriangleWave);
    CHECK(config.encoding[0].dims == 3);
    CHECK(config.encoding[0].frequencies == 12);
    CHECK(config.encoding[1].type == EncodingType::OneBlob);
    CHECK(config.encoding[1].bins == 4);
    CHECK(config.encoding[1].gaussian);
    CHECK(config.encoding[2].dims == 0);
    CHECK(config.encoding[2].scale == 0.5);
    CHECK(config.encoding[2].offset == -1);
    CHECK(config.network.width == 128);
    CHECK(config.network.hiddenLayers == 4);
    CHECK(config.network.outputActivation == OutputActivation::Exponential);
    CHECK(config.network.precision == Precision::Half);
    CHECK(config.network.form == NetworkForm::Workgroup);
    CHECK(describe(config.network) == "FullyFusedMLP 128x4");
    CHECK(config.loss.type == LossType::RelativeL2Luminance);
    CHECK(config.loss.epsilon == 0.02);
    CHECK(config.loss.exponentStart == 1);
    CHECK(config.loss.exponentEnd == 0.5);
    CHECK(config.loss.annealStart == 100);
    CHECK(config.loss.annealEnd == 2000);
    CHECK(config.optimizer.emaDecay == 0.99);
    CHECK(config.optimizer.decayStart == 10);
    CHECK(config.optimizer.decayInterval == 5);
    CHECK(config.optimizer.decayEnd == 90);
    CHECK(config.optimizer.decayBase == 0.33);
    CHECK(config.optimizer.learningRate == 0.001);
    CHECK(config.optimizer.gridLearningRate == 0.001); // follows where it is not given
    CHECK(config.optimizer.beta1 == 0.8);
    CHECK(config.optimizer.beta2 == 0.999);
    CHECK(config.optimizer.epsilon == 1e-15);
    CHECK(config.optimizer.l2 == 0);
    CHECK(config.optimizer.clipNorm == 1.5);
    CHECK(config.optimizer.lossScale == 1024);
}

TEST_CASE("grids and harmonics are read") {
    const ModelConfig config = parse(R"({"encoding": {"otype": "Composite", "nested": [
        {"otype": "HashGrid", "n_dims_to_encode": 3, "n_levels": 16, "n_features_per_level": 4,
         "log2_hashmap_size": 19, "base_resolution": 8, "per_level_scale": 1.5, "aggregation": "Mean"},
        {"otype": "DenseGrid", "n_dims_to_encode": 2, "n_levels": 3},
        {"otype": "SparseGrid", "n_dims_to_encode": 3},
        {"otype": "SphericalHarmonics", "degree": 3}, {"otype": "Frequency", "n_dims_to_encode": 1}]},
        "optimizer": {"otype": "Adam", "learning_rate": 0.5, "grid_learning_rate": 0.25}})");
    REQUIRE(config.encoding.size() == 5);
    const EncodingConfig& hash = config.encoding[0];
    CHECK(hash.type == EncodingType::HashGrid);
    CHECK(hash.levels == 16);
    CHECK(hash.featuresPerLevel == 4);
    CHECK(hash.log2HashmapSize == 19);
    CHECK(hash.baseResolution == 8);
    CHECK(hash.perLevelScale == 1.5);
    CHECK(hash.mean);
    CHECK(config.encoding[1].type == EncodingType::DenseGrid);
    CHECK(config.encoding[1].levels == 3);
    CHECK(config.encoding[2].type == EncodingType::SparseGrid);
    CHECK(config.encoding[3].degree == 3);
    CHECK(config.optimizer.learningRate == 0.5);
    CHECK(config.optimizer.gridLearningRate == 0.25);
}

TEST_CASE("what is left out has its default") {
    const ModelConfig config = parse("{}");
    REQUIRE(config.encoding.size() == 1);
    CHECK(config.encoding[0].type == EncodingType::Identity);
    CHECK(config.network.width == NetworkConfig{}.width);
    CHECK(config.network.hiddenLayers == NetworkConfig{}.hiddenLayers);
    CHECK(config.loss.type == LossType::L2);
    CHECK(config.optimizer.learningRate == OptimizerConfig{}.learningRate);
    CHECK(config.optimizer.emaDecay == 0);
    CHECK(parse(R"({"network": {"n_neurons": 16}})").network.width == 16);
}

TEST_CASE("optimizers nest in any order") {
    const ModelConfig config = parse(R"({"optimizer": {"otype": "ExponentialDecay", "decay_base": 0.5,
        "nested": {"otype": "Ema", "decay": 0.9, "nested": {"otype": "Adam"}}}})");
    CHECK(config.optimizer.emaDecay == 0.9);
    CHECK(config.optimizer.decayBase == 0.5);
    CHECK(parse(R"({"optimizer": {"otype": "Ema", "decay": 0.5, "nested": {"otype": "Adam"}}})")
              .optimizer.emaDecay == 0.5);
}

TEST_CASE("toJson gives every value back") {
    const std::string grids =
        R"({"encoding": {"otype": "HashGrid", "per_level_scale": 1.3819129, "n_levels": 5},
        "optimizer": {"otype": "Adam", "learning_rate": 0.1, "grid_learning_rate": 0.3333333333333333}})";
    const std::string others =
        R"({"encoding": {"otype": "Composite", "nested": [{"otype": "SphericalHarmonics"},
        {"otype": "DenseGrid", "n_dims_to_encode": 2}, {"otype": "SparseGrid", "n_dims_to_encode": 3}]},
        "loss": {"otype": "RelativeL2"}})";
    for (const std::string& json : {std::string(kPaper), grids, others, std::string("{}")}) {
        INFO(json);
        const ModelConfig config = parse(json);
        const std::string text = toJson(config);
        const ModelConfig back = parseModelConfig(text, "recorded");
        CHECK(toJson(back) == text);
        REQUIRE(back.encoding.size() == config.encoding.size());
        for (size_t i = 0; i < config.encoding.size(); ++i) {
            CHECK(back.encoding[i].type == config.encoding[i].type);
            CHECK(back.encoding[i].dims == config.encoding[i].dims);
            CHECK(back.encoding[i].perLevelScale == config.encoding[i].perLevelScale);
        }
        CHECK(back.network.precision == config.network.precision);
        CHECK(back.loss.exponentEnd == config.loss.exponentEnd);
        CHECK(back.loss.annealEnd == config.loss.annealEnd);
        CHECK(back.optimizer.learningRate == config.optimizer.learningRate);
        CHECK(back.optimizer.gridLearningRate == config.optimizer.gridLearningRate);
        CHECK(back.optimizer.decayEnd == config.optimizer.decayEnd);
    }
}

TEST_CASE("unknown keys are refused by their path") {
    checkRefused(R"({"netwrok": {}})", "unknown key netwrok, there are encoding, network, loss, optimizer");
    checkRefused(R"({"network": {"neurons": 64}})",
                 "unknown key network.neurons, there are otype, activation");
    checkRefused(R"({"encoding": {"otype": "Identity", "n_levels": 3}})", "unknown key encoding.n_levels");
    checkRefused(R"({"encoding": {"otype": "DenseGrid", "log2_hashmap_size": 15}})",
                 "unknown key encoding.log2_hashmap_size");
    checkRefused(R"({"encoding": {"otype": "Composite", "nested": [{"otype": "Identity"}], "scale": 1}})",
                 "unknown key encoding.scale");
    checkRefused(R"({"encoding": {"otype": "Composite", "nested": [{"otype": "OneBlob", "bins": 4}]}})",
                 "unknown key encoding.nested[0].bins");
    checkRefused(R"({"loss": {"otype": "L2", "epsilon": 0.1}})", "unknown key loss.epsilon");
    checkRefused(R"({"optimizer": {"otype": "Ema", "nested": {"otype": "Adam", "lr": 1}}})",
                 "unknown key optimizer.nested.lr");
    checkRefused(R"({"optimizer": {"otype": "Adam", "nested": {"otype": "Adam"}}})",
                 "unknown key optimizer.nested");
    checkRefused(R"({"network": {"n_neurons": 64, "n_neurons": 32}})", "\"n_neurons\" is given twice");
}

TEST_CASE("unknown otypes and names are refused with those there are") {
    checkRefused(R"({"encoding": {"otype": "Fourier"}})",
                 "encoding.otype must be one of Empty, Identity, Frequency");
    checkRefused(R"({"encoding": {"otype": "Fourier"}})", "not \"Fourier\"");
    checkRefused(R"({"encoding": {}})", "encoding.otype is missing");
    checkRefused(R"({"encoding": {"otype": "Composite", "nested": [{"otype": "Composite"}]}})",
                 "encoding.nested[0].otype must be one of");
    checkRefused(R"({"network": {"otype": "CutlassMLP"}})", "network.otype must be one of FullyFusedMLP");
    checkRefused(R"({"network": {"activation": "Tanh"}})", "network.activation must be one of ReLU");
    checkRefused(R"({"network": {"output_activation": "Sine"}})", "network.output_activation must be one of");
    checkRefused(R"({"network": {"precision": "Double"}})", "network.precision must be one of Float, Half");
    checkRefused(R"({"network": {"form": 3}})",
                 "network.form must be one of Auto, Subgroup, Workgroup, not 3");
    checkRefused(R"({"loss": {"otype": "L1"}})", "loss.otype must be one of L2, RelativeL2");
    checkRefused(R"({"loss": {}})", "loss.otype is missing");
    checkRefused(R"({"optimizer": {"otype": "SGD"}})", "optimizer.otype must be one of Adam, Ema");
    checkRefused(R"({"encoding": {"otype": "OneBlob", "kernel": "Box"}})", "encoding.kernel must be one of");
    checkRefused(R"({"encoding": {"otype": "HashGrid", "aggregation": "Sum"}})",
                 "encoding.aggregation must be one of Concatenation, Mean");
}

TEST_CASE("values out of range are refused with the range") {
    const auto network = [](const std::string& member) { return "{\"network\": {" + member + "}}"; };
    const auto part = [](const std::string& otype, const std::string& member) {
        return "{\"encoding\": {\"otype\": \"" + otype + "\", " + member + "}}";
    };
    const auto adam = [](const std::string& member) {
        return "{\"optimizer\": {\"otype\": \"Adam\", " + member + "}}";
    };
    checkRefused(network("\"n_neurons\": 65"), "network.n_neurons must be one of 16, 32, 64, 128, not 65");
    checkRefused(network("\"n_neurons\": 64.0"), "network.n_neurons must be one of");
    checkRefused(network("\"n_neurons\": \"64\""), "not \"64\"");
    checkRefused(network("\"n_hidden_layers\": 0"),
                 "network.n_hidden_layers must be a whole number from 1 to 8");
    checkRefused(network("\"n_hidden_layers\": -1"), "not -1");
    checkRefused(network("\"n_hidden_layers\": 18446744073709551616"), "network.n_hidden_layers");
    checkRefused(network("\"n_hidden_layers\": 4294967297"), "network.n_hidden_layers");
    checkRefused(part("Frequency", "\"n_frequencies\": 17"), "encoding.n_frequencies");
    checkRefused(part("TriangleWave", "\"n_frequencies\": null"), "encoding.n_frequencies");
    checkRefused(part("OneBlob", "\"n_bins\": 65"), "encoding.n_bins");
    checkRefused(part("SphericalHarmonics", "\"degree\": 5"), "encoding.degree");
    checkRefused(part("HashGrid", "\"n_levels\": 17"), "encoding.n_levels");
    checkRefused(part("HashGrid", "\"n_features_per_level\": 3"), "encoding.n_features_per_level");
    checkRefused(part("HashGrid", "\"log2_hashmap_size\": 25"), "encoding.log2_hashmap_size");
    checkRefused(part("HashGrid", "\"per_level_scale\": 0.5"), "encoding.per_level_scale");
    checkRefused(part("HashGrid", "\"base_resolution\": 0"), "encoding.base_resolution");
    checkRefused(part("HashGrid", "\"n_levels\": 16, \"per_level_scale\": 4"), "cells an edge");
    checkRefused(part("Identity", "\"scale\": 1e7"), "encoding.scale");
    checkRefused(adam("\"learning_rate\": -1"), "optimizer.learning_rate");
    checkRefused(adam("\"learning_rate\": true"), "optimizer.learning_rate");
    checkRefused(adam("\"beta1\": 1"), "optimizer.beta1 must be a number from 0 to below 1, not 1");
    checkRefused(adam("\"epsilon\": 0"), "optimizer.epsilon must be a number from 1e-18 to 1, not 0");
    checkRefused(adam("\"clip_norm\": -1"), "optimizer.clip_norm");
    checkRefused(adam("\"loss_scale\": 0"), "optimizer.loss_scale");
    checkRefused(R"({"optimizer": {"otype": "Ema", "decay": 1, "nested": {"otype": "Adam"}}})",
                 "optimizer.decay must be");
    checkRefused(R"({"loss": {"otype": "RelativeL2", "exponent": [1]}})",
                 "loss.exponent must be a list of two");
    checkRefused(R"({"loss": {"otype": "RelativeL2", "exponent": [1, 2]}})", "loss.exponent");
    checkRefused(R"({"loss": {"otype": "RelativeL2", "anneal": [5, 4]}})", "loss.anneal");
}

TEST_CASE("sections of the wrong shape are refused") {
    checkRefused("[]", "the file must be an object, not []");
    checkRefused("3", "the file must be an object");
    checkRefused(R"({"network": [64, 5]})", "network must be an object, not [64,5]");
    checkRefused(R"({"encoding": null})", "encoding must be an object");
    checkRefused(R"({"encoding": {"otype": "Composite"}})", "encoding.nested is missing");
    checkRefused(R"({"encoding": {"otype": "Composite", "nested": []}})",
                 "a list of 1 to 16 encodings, not []");
    checkRefused(R"({"encoding": {"otype": "Composite", "nested": {"otype": "Identity"}}})",
                 "a list of 1 to 16");
    checkRefused(R"({"encoding": {"otype": "Composite", "nested": ["Identity"]}})",
                 "encoding.nested[0] must be an object");
    checkRefused(
        R"({"encoding": {"otype": "Composite", "nested": [{"otype": "Identity"}, {"otype": "OneBlob"}]}})",
        "n_dims_to_encode may be 0 or missing in one part only");
    checkRefused(R"({"optimizer": {"otype": "Ema", "decay": 0.9}})", "optimizer.nested is missing");
    checkRefused(
        R"({"optimizer": {"otype": "Ema", "nested": {"otype": "Ema", "nested": {"otype": "Adam"}}}})",
        "optimizer.nested.otype must be another");
    checkRefused(R"({"optimizer": {"otype": "Ema", "nested": 3}})",
                 "optimizer.nested must be an object, not 3");
}

TEST_CASE("hostile text is refused") {
    checkRefused("", "not JSON");
    checkRefused("{\"network\": {\"n_neurons\": 64}", "not JSON");
    checkRefused("{\"network\": {\"n_neurons\": 1e999}}", "not JSON");
    checkRefused("{\"network\": NaN}", "not JSON");
    checkRefused("\xff\xfe{}", "not JSON");
    checkRefused("{\"net\xff\": 1}", "not JSON");
    checkRefused(std::string("{}\0{}", 5), "not JSON");
    checkRefused(nested(30000, "[", "]"), "nested deeper than 16");
    checkRefused(std::string(60000, '['), "nested deeper than 16");
    checkRefused(nested(10000, "{\"a\":", "}"), "nested deeper than 16");
    checkRefused(R"({"optimizer":)" + nested(9, R"({"otype":"Ema","nested":)", "}") + "}",
                 "optimizer.nested.otype");
    checkRefused("{\"a\\nb\": 1}", "unknown key \"a\\nb\""); // stays on one line
    checkRefused("{\"" + std::string(50000, 'k') + "\": 1}", "kkk...");
    checkRefused(nested(100000, "[", "]"), "bytes are too many");
    checkRefused("{\"network\": \"" + std::string(1u << 20, 'x') + "\"}", "bytes are too many");
    std::string list = "{\"encoding\": {\"otype\": \"Composite\", \"nested\": [";
    for (int i = 0; i < 20000; ++i) list += "{},";
    checkRefused(list + "{}]}}", "a list of 1 to 16 encodings");
}

TEST_CASE("a file is named in its errors") {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& name, const std::string& text) {
        return folder.write(name, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
    };
    CHECK(loadModelConfig(write("good.json", kPaper)).network.width == 128);
    const auto bad = write("bad.json", R"({"network": {"n_neurons": 1}})");
    expectError(ExitCode::BadData, "bad.json: network.n_neurons", [&] { loadModelConfig(bad); });
    const auto large = write("large.json", std::string(2u << 20, ' '));
    expectError(ExitCode::BadData, "large.json", [&] { loadModelConfig(large); });
    expectError(ExitCode::NotFound, "none.json", [&] { loadModelConfig(folder / "none.json"); });
    expectError(ExitCode::Io, "not a regular file", [&] { loadModelConfig(folder / "."); });
}
