#include "tests/support/whole_model.h"

#include <nlohmann/json.hpp>

namespace irradia::test {
namespace {

using Json = nlohmann::json;

constexpr const char* kNetwork = R"({"n_neurons": 64, "n_hidden_layers": 5})";
constexpr const char* kAdam = R"({"otype": "Adam", "learning_rate": 0.01, "beta1": 0.9, "beta2": 0.99,
    "epsilon": 1e-8, "l2_reg": 1e-6})";
constexpr const char* kParts = R"({"Identity": {}, "Frequency": {"n_frequencies": 12},
    "TriangleWave": {"n_frequencies": 12}, "OneBlob": {"n_bins": 4}, "SphericalHarmonics": {"degree": 4},
    "DenseGrid": {"n_levels": 8, "n_features_per_level": 2, "base_resolution": 16, "per_level_scale": 2},
    "SparseGrid": {"n_levels": 8, "n_features_per_level": 2, "base_resolution": 16, "per_level_scale": 2},
    "HashGrid": {"n_levels": 8, "n_features_per_level": 2, "log2_hashmap_size": 15, "base_resolution": 16,
                 "per_level_scale": 2}})";

Json completed(const std::string& section, const Json& given) {
    if (!given.is_object()) return given;
    Json whole = Json::object();
    const Json parts = Json::parse(kParts);
    const std::string otype = given.contains("otype") ? given["otype"].get<std::string>() : "";
    if (section == "network") whole = Json::parse(kNetwork);
    if (section == "encoding" && parts.contains(otype)) whole = parts[otype];
    if (section == "loss" && otype.starts_with("Relative")) whole["epsilon"] = 0.01;
    if (section == "optimizer" && otype == "Adam") whole = Json::parse(kAdam);
    if (section == "optimizer" && otype == "Ema") whole["decay"] = 0.0;
    if (section == "optimizer" && otype == "ExponentialDecay")
        whole = {{"decay_interval", 0}, {"decay_base", 1}};
    whole.update(given);
    if (!whole.contains("nested")) return whole;
    Json& nested = whole["nested"];
    if (nested.is_array())
        for (Json& part : nested) part = completed(section, part);
    else
        nested = completed(section, nested);
    return whole;
}

} // namespace

std::string wholeModel(const std::string& sections) {
    const Json given = Json::parse(sections);
    Json model{{"encoding", {{"otype", "Identity"}}},
               {"network", Json::parse(kNetwork)},
               {"loss", {{"otype", "L2"}}},
               {"optimizer", Json::parse(kAdam)}};
    for (const auto& [section, value] : given.items()) model[section] = completed(section, value);
    return model.dump();
}

} // namespace irradia::test
