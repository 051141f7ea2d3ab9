#include "nrc/learning/config.h"

#include "engine/error.h"
#include "nrc/learning/config_names.h"
#include "nrc/learning/encodings/table.h"
#include <algorithm>

namespace irradia {
namespace {

using Json = nlohmann::json;

constexpr size_t kMaxParts = 16; // of a composite
// Second moments below 1e-38 vanish in single precision, so that steps would be divided by epsilon alone.
constexpr double kSmallestAdamEpsilon = 1e-18;

EncodingConfig readPart(const Json& json, const std::string& file, const std::string& path) {
    JsonFields fields(json, file, path);
    EncodingConfig config;
    const EncodingKind& kind = encodingKinds()[fields.choice("otype", encodingNames())];
    config.otype = kind.otype;
    config.dims = fields.integer("n_dims_to_encode", config.dims, 0, 64);
    for (const EncodingKey& key : kind.keys) config.keys[key.name] = key.read(fields);
    if (kind.checkKeys) kind.checkKeys(fields, config);
    fields.finish();
    return config;
}

// Of a composite's parts, the inputs of one alone may be those that are left.
void requireClearDims(const std::vector<EncodingConfig>& parts, const JsonFields& fields) {
    const auto isOpen = [](const EncodingConfig& part) { return part.dims == 0; };
    if (std::ranges::count_if(parts, isOpen) > 1)
        fail(ExitCode::BadData,
             "{}: {}: n_dims_to_encode may be 0 or missing in one part only, the one that takes the inputs "
             "that are left",
             fields.file(), fields.pathOf("nested"));
}

std::vector<EncodingConfig> readEncoding(const Json& json, const std::string& file, const std::string& path) {
    JsonFields fields(json, file, path);
    const Json* otype = fields.member("otype");
    if (!otype || *otype != "Composite") return {readPart(json, file, path)};
    const Json* nested = fields.member("nested");
    fields.finish();
    if (!nested || !nested->is_array() || nested->empty() || nested->size() > kMaxParts)
        fields.refuse("nested", fmt::format("a list of 1 to {} encodings", kMaxParts));
    std::vector<EncodingConfig> parts;
    for (const Json& part : *nested)
        parts.push_back(readPart(part, file, fmt::format("{}.nested[{}]", path, parts.size())));
    requireClearDims(parts, fields);
    return parts;
}

NetworkConfig readNetwork(const Json& json, const std::string& file, const std::string& path) {
    enum class NetworkType { FullyFused };
    enum class Activation { ReLU };
    constexpr EnumName<NetworkType> kTypes[] = {{NetworkType::FullyFused, "FullyFusedMLP"}};
    constexpr EnumName<Activation> kActivations[] = {{Activation::ReLU, "ReLU"}};
    JsonFields fields(json, file, path);
    NetworkConfig config;
    fields.choice("otype", NetworkType::FullyFused, kTypes);
    fields.choice("activation", Activation::ReLU, kActivations);
    config.outputActivation =
        fields.choice("output_activation", config.outputActivation, kOutputActivationNames);
    config.width = fields.integer("n_neurons", {16, 32, 64, 128});
    config.hiddenLayers = fields.integer("n_hidden_layers", 1, 8);
    config.precision = fields.choice("precision", config.precision, kPrecisionNames);
    config.form = fields.choice("form", config.form, kFormNames);
    fields.finish();
    return config;
}

LossConfig readLoss(const Json& json, const std::string& file, const std::string& path) {
    JsonFields fields(json, file, path);
    LossConfig config;
    config.type = fields.choice("otype", kLossNames);
    if (config.type != LossType::L2) {
        config.epsilon = fields.number("epsilon", {0, 1e6, NumberRange::LowOpen});
        double exponent[2] = {config.exponentStart, config.exponentEnd};
        fields.numberPair("exponent", exponent, {0, 1});
        config.exponentStart = exponent[0];
        config.exponentEnd = exponent[1];
        fields.integerPair("anneal", config.annealStart, config.annealEnd);
    }
    fields.finish();
    return config;
}

void readAdam(JsonFields& fields, OptimizerConfig& config) {
    config.learningRate = fields.number("learning_rate", {0, 10});
    config.gridLearningRate = fields.number("grid_learning_rate", config.learningRate, {0, 10});
    config.beta1 = fields.number("beta1", {0, 1, NumberRange::HighOpen});
    config.beta2 = fields.number("beta2", {0, 1, NumberRange::HighOpen});
    config.epsilon = fields.number("epsilon", {kSmallestAdamEpsilon, 1});
    config.l2 = fields.number("l2_reg", {0, 1});
    config.clipNorm = fields.number("clip_norm", config.clipNorm, {0, 1e9});
    config.lossScale = fields.number("loss_scale", config.lossScale, {1, 1 << 20});
}

void readDecay(JsonFields& fields, OptimizerConfig& config) {
    config.decayStart = fields.integer("decay_start", config.decayStart, 0, UINT32_MAX);
    config.decayInterval = fields.integer("decay_interval", 0, UINT32_MAX);
    config.decayEnd = fields.integer("decay_end", config.decayEnd, 0, UINT32_MAX);
    config.decayBase = fields.number("decay_base", {0, 1, NumberRange::LowOpen});
}

// Ema and ExponentialDecay, each at most once and in any order, around an Adam.
OptimizerConfig readOptimizer(const Json& json, const std::string& file, std::string path) {
    OptimizerConfig config;
    std::vector<OptimizerType> met;
    for (const Json* level = &json; level; path += ".nested") {
        JsonFields fields(*level, file, path);
        const OptimizerType type = fields.choice("otype", kOptimizerNames);
        if (std::ranges::find(met, type) != met.end()) fields.refuse("otype", "another than those around it");
        met.push_back(type);
        if (type == OptimizerType::Adam) readAdam(fields, config);
        if (type == OptimizerType::Ema)
            config.emaDecay = fields.number("decay", {0, 1, NumberRange::HighOpen});
        if (type == OptimizerType::ExponentialDecay) readDecay(fields, config);
        level = type == OptimizerType::Adam ? nullptr : fields.member("nested");
        fields.finish();
        if (type != OptimizerType::Adam && !level)
            fields.refuse("nested", "an optimizer, in the end an Adam");
    }
    return config;
}

} // namespace

double EncodingConfig::number(const std::string& key) const {
    const auto found = keys.find(key);
    if (found == keys.end()) fail(ExitCode::Internal, "encoding: a {} has no {}", otype, key);
    return found->second;
}

EncodingConfig makeEncoding(const std::string& otype, uint32_t dims, std::map<std::string, double> given) {
    EncodingConfig config{otype, dims};
    for (const EncodingKey& key : encodingKind(otype).keys) config.keys[key.name] = key.standard;
    for (const auto& [key, value] : given) {
        config.number(key);
        config.keys[key] = value;
    }
    return config;
}

ModelConfig loadModelConfig(const std::filesystem::path& file) {
    return readModelConfig(loadJson(file), file.string(), "");
}

ModelConfig parseModelConfig(const std::string& json, const std::string& name) {
    return readModelConfig(parseJson(json, name), name, "");
}

ModelConfig readModelConfig(const Json& json, const std::string& name, const std::string& path) {
    JsonFields fields(json, name, path);
    const Json& encoding = fields.section("encoding");
    const Json& network = fields.section("network");
    const Json& loss = fields.section("loss");
    const Json& optimizer = fields.section("optimizer");
    fields.finish();
    return {readEncoding(encoding, name, fields.pathOf("encoding")),
            readNetwork(network, name, fields.pathOf("network")), readLoss(loss, name, fields.pathOf("loss")),
            readOptimizer(optimizer, name, fields.pathOf("optimizer"))};
}

} // namespace irradia
