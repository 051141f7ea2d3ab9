// A model's JSON: what is read, what is refused with which words, and that hostile files are refused too.
#include "engine/error.h"
#include "nrc/learning/config.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/whole_model.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstring>
#include <nlohmann/json.hpp>

using namespace irradia;
using irradia::test::expectError;
using irradia::test::TemporaryFolder;
using irradia::test::wholeModel;

namespace {

using Json = nlohmann::json;

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

// The same of a model that is whole but for what `json` says.
void checkRefusedIn(const std::string& json, const std::string& words) {
    checkRefused(wholeModel(json), words);
}

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
    CHECK(config.encoding[0].otype == "TriangleWave");
    CHECK(config.encoding[0].dims == 3);
    CHECK(config.encoding[0].number("n_frequencies") == 12);
    CHECK(config.encoding[1].otype == "OneBlob");
    CHECK(config.encoding[1].number("n_bins") == 4);
    CHECK(config.encoding[1].number("kernel") == 1); // Gaussian
    CHECK(config.encoding[2].dims == 0);
    CHECK(config.encoding[2].number("scale") == 0.5);
    CHECK(config.encoding[2].number("offset") == -1);
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
    const ModelConfig config = parse(wholeModel(R"({"encoding": {"otype": "Composite", "nested": [
        {"otype": "HashGrid", "n_dims_to_encode": 3, "n_levels": 16, "n_features_per_level": 4,
         "log2_hashmap_size": 19, "base_resolution": 8, "per_level_scale": 1.5, "aggregation": "Mean"},
        {"otype": "DenseGrid", "n_dims_to_encode": 2, "n_levels": 3},
        {"otype": "SparseGrid", "n_dims_to_encode": 3},
        {"otype": "SphericalHarmonics", "degree": 3}, {"otype": "Frequency", "n_dims_to_encode": 1}]},
        "optimizer": {"otype": "Adam", "learning_rate": 0.5, "grid_learning_rate": 0.25}})"));
    REQUIRE(config.encoding.size() == 5);
    const EncodingConfig& hash = config.encoding[0];
    CHECK(hash.otype == "HashGrid");
    CHECK(hash.number("n_levels") == 16);
    CHECK(hash.number("n_features_per_level") == 4);
    CHECK(hash.number("log2_hashmap_size") == 19);
    CHECK(hash.number("base_resolution") == 8);
    CHECK(hash.number("per_level_scale") == 1.5);
    CHECK(hash.number("aggregation") == 1); // Mean
    CHECK(config.encoding[1].otype == "DenseGrid");
    CHECK(config.encoding[1].number("n_levels") == 3);
    CHECK(config.encoding[2].otype == "SparseGrid");
    CHECK(config.encoding[3].number("degree") == 3);
    CHECK(config.optimizer.learningRate == 0.5);
    CHECK(config.optimizer.gridLearningRate == 0.25);
}

TEST_CASE("what may be left out means nothing is done") {
    const ModelConfig config = parse(wholeModel(R"({"loss": {"otype": "RelativeL2"}})"));
    REQUIRE(config.encoding.size() == 1);
    CHECK(config.encoding[0].number("scale") == 1);
    CHECK(config.encoding[0].number("offset") == 0);
    CHECK(config.encoding[0].dims == 0);
    CHECK(config.network.outputActivation == OutputActivation::None);
    CHECK(config.network.precision == Precision::Float);
    CHECK(config.network.form == NetworkForm::Auto);
    CHECK(config.loss.exponentStart == 1);
    CHECK(config.loss.exponentEnd == 1);
    CHECK(config.optimizer.gridLearningRate == 0.01);
    CHECK(config.optimizer.emaDecay == 0);
    CHECK(config.optimizer.decayInterval == 0);
    CHECK(config.optimizer.clipNorm == 0);
    CHECK(config.optimizer.lossScale == 1);
}

namespace {

// Removes one key after the other, wherever it stands, and says which were missed by name.
std::vector<std::string> missedKeys(const std::string& text) {
    std::vector<std::string> missed;
    const Json model = Json::parse(text), flat = model.flatten();
    for (const auto& [pointer, value] : flat.items()) {
        const Json::json_pointer place(pointer);
        if (model[place.parent_pointer()].is_array()) continue; // of a number's place in a pair
        Json without = model;
        without[place.parent_pointer()].erase(place.back());
        try {
            parse(without.dump());
        } catch (const Error& error) {
            const std::string sentence = error.what();
            INFO(sentence);
            CHECK(error.code() == ExitCode::BadData);
            CHECK(sentence.find(place.back() + " is missing") != std::string::npos);
            missed.push_back(place.back());
        }
    }
    return missed;
}

} // namespace

TEST_CASE("whatever decides what is learned is missed by name") {
    const std::string kinds = wholeModel(R"({
        "encoding": {"otype": "Composite", "nested": [{"otype": "HashGrid", "n_dims_to_encode": 3},
            {"otype": "TriangleWave", "n_dims_to_encode": 1}, {"otype": "OneBlob", "n_dims_to_encode": 1},
            {"otype": "SphericalHarmonics", "n_dims_to_encode": 2},
            {"otype": "Identity", "n_dims_to_encode": 6}]},
        "loss": {"otype": "RelativeL2"},
        "optimizer": {"otype": "Ema", "nested": {"otype": "ExponentialDecay", "nested": {"otype": "Adam"}}}})");
    std::vector<std::string> missed = missedKeys(kinds);
    std::ranges::sort(missed);
    const auto last = std::ranges::unique(missed).begin();
    missed.erase(last, missed.end());
    CHECK(missed == std::vector<std::string>{"base_resolution", "beta1", "beta2", "decay", "decay_base",
                                             "decay_interval", "degree", "epsilon", "l2_reg", "learning_rate",
                                             "log2_hashmap_size", "n_bins", "n_features_per_level",
                                             "n_frequencies", "n_hidden_layers", "n_levels", "n_neurons",
                                             "otype", "per_level_scale"});
    for (const char* section : {"encoding", "network", "loss", "optimizer"}) {
        Json without = Json::parse(kinds);
        without.erase(section);
        checkRefused(without.dump(), std::string(section) + " is missing, it must be an object");
    }
    checkRefused("{}", "encoding is missing");
    checkRefused(R"({"network": {"n_neurons": 64}})", "encoding is missing");
}

TEST_CASE("optimizers nest in any order") {
    const ModelConfig config =
        parse(wholeModel(R"({"optimizer": {"otype": "ExponentialDecay", "decay_base": 0.5,
        "nested": {"otype": "Ema", "decay": 0.9, "nested": {"otype": "Adam"}}}})"));
    CHECK(config.optimizer.emaDecay == 0.9);
    CHECK(config.optimizer.decayBase == 0.5);
    CHECK(parse(wholeModel(R"({"optimizer": {"otype": "Ema", "decay": 0.5, "nested": {"otype": "Adam"}}})"))
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
    for (const std::string& json :
         {std::string(kPaper), wholeModel(grids), wholeModel(others), wholeModel("{}")}) {
        INFO(json);
        const ModelConfig config = parse(json);
        CHECK(parseModelConfig(toJson(config), "recorded") == config);
    }
}

TEST_CASE("unknown keys are refused by their path") {
    checkRefusedIn(R"({"netwrok": {}})", "unknown key netwrok, there are encoding, network, loss, optimizer");
    checkRefusedIn(R"({"network": {"neurons": 64}})",
                   "unknown key network.neurons, there are otype, activation");
    checkRefusedIn(R"({"encoding": {"otype": "Identity", "n_levels": 3}})", "unknown key encoding.n_levels");
    checkRefusedIn(R"({"encoding": {"otype": "DenseGrid", "log2_hashmap_size": 15}})",
                   "unknown key encoding.log2_hashmap_size");
    checkRefusedIn(R"({"encoding": {"otype": "Composite", "nested": [{"otype": "Identity"}], "scale": 1}})",
                   "unknown key encoding.scale");
    checkRefusedIn(R"({"encoding": {"otype": "Composite", "nested": [{"otype": "OneBlob", "bins": 4}]}})",
                   "unknown key encoding.nested[0].bins");
    checkRefusedIn(R"({"loss": {"otype": "L2", "epsilon": 0.1}})", "unknown key loss.epsilon");
    checkRefusedIn(R"({"optimizer": {"otype": "Ema", "nested": {"otype": "Adam", "lr": 1}}})",
                   "unknown key optimizer.nested.lr");
    checkRefusedIn(R"({"optimizer": {"otype": "Adam", "nested": {"otype": "Adam"}}})",
                   "unknown key optimizer.nested");
    checkRefused(R"({"network": {"n_neurons": 64, "n_neurons": 32}})", "\"n_neurons\" is given twice");
}

TEST_CASE("unknown otypes and names are refused with those there are") {
    checkRefusedIn(R"({"encoding": {"otype": "Fourier"}})",
                   "encoding.otype must be one of Empty, Identity, Frequency");
    checkRefusedIn(R"({"encoding": {"otype": "Fourier"}})", "not \"Fourier\"");
    checkRefusedIn(R"({"encoding": {}})", "encoding.otype is missing");
    checkRefusedIn(R"({"encoding": {"otype": "Composite", "nested": [{"otype": "Composite"}]}})",
                   "encoding.nested[0].otype must be one of");
    checkRefusedIn(R"({"network": {"otype": "CutlassMLP"}})", "network.otype must be one of FullyFusedMLP");
    checkRefusedIn(R"({"network": {"activation": "Tanh"}})", "network.activation must be one of ReLU");
    checkRefusedIn(R"({"network": {"output_activation": "Sine"}})",
                   "network.output_activation must be one of");
    checkRefusedIn(R"({"network": {"precision": "Double"}})", "network.precision must be one of Float, Half");
    checkRefusedIn(R"({"network": {"form": 3}})",
                   "network.form must be one of Auto, Subgroup, Workgroup, not 3");
    checkRefusedIn(R"({"loss": {"otype": "L1"}})", "loss.otype must be one of L2, RelativeL2");
    checkRefusedIn(R"({"loss": {}})", "loss.otype is missing");
    checkRefusedIn(R"({"optimizer": {"otype": "SGD"}})", "optimizer.otype must be one of Adam, Ema");
    checkRefusedIn(R"({"encoding": {"otype": "OneBlob", "kernel": "Box"}})",
                   "encoding.kernel must be one of");
    checkRefusedIn(R"({"encoding": {"otype": "HashGrid", "aggregation": "Sum"}})",
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
    checkRefusedIn(network("\"n_neurons\": 65"), "network.n_neurons must be one of 16, 32, 64, 128, not 65");
    checkRefusedIn(network("\"n_neurons\": 64.0"), "network.n_neurons must be one of");
    checkRefusedIn(network("\"n_neurons\": \"64\""), "not \"64\"");
    checkRefusedIn(network("\"n_hidden_layers\": 0"),
                   "network.n_hidden_layers must be a whole number from 1 to 8");
    checkRefusedIn(network("\"n_hidden_layers\": -1"), "not -1");
    checkRefusedIn(network("\"n_hidden_layers\": 18446744073709551616"), "network.n_hidden_layers");
    checkRefusedIn(network("\"n_hidden_layers\": 4294967297"), "network.n_hidden_layers");
    checkRefusedIn(part("Frequency", "\"n_frequencies\": 17"), "encoding.n_frequencies");
    checkRefusedIn(part("TriangleWave", "\"n_frequencies\": null"), "encoding.n_frequencies");
    checkRefusedIn(part("OneBlob", "\"n_bins\": 65"), "encoding.n_bins");
    checkRefusedIn(part("SphericalHarmonics", "\"degree\": 5"), "encoding.degree");
    checkRefusedIn(part("HashGrid", "\"n_levels\": 17"), "encoding.n_levels");
    checkRefusedIn(part("HashGrid", "\"n_features_per_level\": 3"), "encoding.n_features_per_level");
    checkRefusedIn(part("HashGrid", "\"log2_hashmap_size\": 25"), "encoding.log2_hashmap_size");
    checkRefusedIn(part("HashGrid", "\"per_level_scale\": 0.5"), "encoding.per_level_scale");
    checkRefusedIn(part("HashGrid", "\"base_resolution\": 0"), "encoding.base_resolution");
    checkRefusedIn(part("HashGrid", "\"n_levels\": 16, \"per_level_scale\": 4"), "cells an edge");
    checkRefusedIn(part("Identity", "\"scale\": 1e7"), "encoding.scale");
    checkRefusedIn(adam("\"learning_rate\": -1"), "optimizer.learning_rate");
    checkRefusedIn(adam("\"learning_rate\": true"), "optimizer.learning_rate");
    checkRefusedIn(adam("\"beta1\": 1"), "optimizer.beta1 must be a number from 0 to below 1, not 1");
    checkRefusedIn(adam("\"epsilon\": 0"), "optimizer.epsilon must be a number from 1e-18 to 1, not 0");
    checkRefusedIn(adam("\"clip_norm\": -1"), "optimizer.clip_norm");
    checkRefusedIn(adam("\"loss_scale\": 0"), "optimizer.loss_scale");
    checkRefusedIn(R"({"optimizer": {"otype": "Ema", "decay": 1, "nested": {"otype": "Adam"}}})",
                   "optimizer.decay must be");
    checkRefusedIn(R"({"loss": {"otype": "RelativeL2", "exponent": [1]}})",
                   "loss.exponent must be a list of two");
    checkRefusedIn(R"({"loss": {"otype": "RelativeL2", "exponent": [1, 2]}})", "loss.exponent");
    checkRefusedIn(R"({"loss": {"otype": "RelativeL2", "anneal": [5, 4]}})", "loss.anneal");
}

TEST_CASE("sections of the wrong shape are refused") {
    checkRefused("[]", "the file must be an object, not []");
    checkRefused("3", "the file must be an object");
    checkRefusedIn(R"({"network": [64, 5]})", "network must be an object, not [64,5]");
    checkRefusedIn(R"({"encoding": null})", "encoding must be an object");
    checkRefusedIn(R"({"encoding": {"otype": "Composite"}})", "encoding.nested is missing");
    checkRefusedIn(R"({"encoding": {"otype": "Composite", "nested": []}})",
                   "a list of 1 to 16 encodings, not []");
    checkRefusedIn(R"({"encoding": {"otype": "Composite", "nested": {"otype": "Identity"}}})",
                   "a list of 1 to 16");
    checkRefusedIn(R"({"encoding": {"otype": "Composite", "nested": ["Identity"]}})",
                   "encoding.nested[0] must be an object");
    checkRefusedIn(
        R"({"encoding": {"otype": "Composite", "nested": [{"otype": "Identity"}, {"otype": "OneBlob"}]}})",
        "n_dims_to_encode may be 0 or missing in one part only");
    checkRefusedIn(R"({"optimizer": {"otype": "Ema", "decay": 0.9}})", "optimizer.nested is missing");
    checkRefusedIn(
        R"({"optimizer": {"otype": "Ema", "nested": {"otype": "Ema", "nested": {"otype": "Adam"}}}})",
        "optimizer.nested.otype must be another");
    checkRefusedIn(R"({"optimizer": {"otype": "Ema", "nested": 3}})",
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
    checkRefusedIn(R"({"optimizer":)" + nested(9, R"({"otype":"Ema","nested":)", "}") + "}",
                   "optimizer.nested.otype");
    checkRefusedIn("{\"a\\nb\": 1}", "unknown key \"a\\nb\""); // stays on one line
    checkRefusedIn("{\"" + std::string(50000, 'k') + "\": 1}", "kkk...");
    checkRefused(nested(100000, "[", "]"), "bytes are too many");
    checkRefused("{\"network\": \"" + std::string(1u << 20, 'x') + "\"}", "bytes are too many");
    std::string list = "{\"encoding\": {\"otype\": \"Composite\", \"nested\": [";
    for (int i = 0; i < 20000; ++i) list += "{},";
    checkRefusedIn(list + "{}]}}", "a list of 1 to 16 encodings");
}

TEST_CASE("a file is named in its errors") {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& name, const std::string& text) {
        return folder.write(name, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
    };
    CHECK(loadModelConfig(write("good.json", kPaper)).network.width == 128);
    const auto bad = write("bad.json", wholeModel(R"({"network": {"n_neurons": 1}})"));
    expectError(ExitCode::BadData, "bad.json: network.n_neurons", [&] { loadModelConfig(bad); });
    const auto large = write("large.json", std::string(2u << 20, ' '));
    expectError(ExitCode::BadData, "large.json", [&] { loadModelConfig(large); });
    expectError(ExitCode::NotFound, "none.json", [&] { loadModelConfig(folder / "none.json"); });
    expectError(ExitCode::Io, "not a regular file", [&] { loadModelConfig(folder / "."); });
}
