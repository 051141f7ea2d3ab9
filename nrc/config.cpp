#include "nrc/config.h"

#include "engine/error.h"
#include "engine/image/read_file.h"
#include "nrc/config_names.h"
#include <algorithm>
#include <cmath>

namespace irradia {
namespace {

using Json = nlohmann::json;

constexpr size_t kMaxParts = 16; // of a composite
// Second moments below 1e-38 vanish in single precision, so that steps would be divided by epsilon alone.
constexpr double kSmallestAdamEpsilon = 1e-18;
constexpr double kFinestResolution =
    1 << 20; // a coordinate in single precision still tells 16 places in a cell

// The otype that a section must have.
template <typename Enum, size_t N>
Enum typeOf(JsonFields& fields, const EnumName<Enum> (&names)[N]) {
    if (!fields.has("otype")) {
        std::vector<const char*> texts;
        for (const EnumName<Enum>& entry : names) texts.push_back(entry.name);
        fields.refuse("otype", fmt::format("one of {}", fmt::join(texts, ", ")));
    }
    return fields.choice("otype", names[0].value, names);
}

void readGrid(JsonFields& fields, EncodingConfig& config) {
    config.levels = fields.integer("n_levels", config.levels, 1, 16);
    config.featuresPerLevel =
        fields.integer("n_features_per_level", config.featuresPerLevel, {1, 2, 4, 8, 16});
    if (config.type == EncodingType::HashGrid)
        config.log2HashmapSize = fields.integer("log2_hashmap_size", config.log2HashmapSize, 4, 24);
    config.baseResolution = fields.integer("base_resolution", config.baseResolution, 1, 1u << 16);
    config.perLevelScale = fields.number("per_level_scale", config.perLevelScale, {1, 16});
    config.mean = fields.choice("aggregation", config.mean, kAggregationNames);
    const double finest = config.baseResolution * std::pow(config.perLevelScale, config.levels - 1);
    if (finest > kFinestResolution)
        fail(ExitCode::BadData,
             "{}: {}, n_levels and per_level_scale make a finest level of {:.4g} cells an edge, at most {} "
             "are allowed",
             fields.file(), fields.pathOf("base_resolution"), finest, kFinestResolution);
}

EncodingConfig readPart(const Json& json, const std::string& file, const std::string& path) {
    JsonFields fields(json, file, path);
    EncodingConfig config;
    config.type = typeOf(fields, kEncodingNames);
    config.dims = fields.integer("n_dims_to_encode", config.dims, 0, 64);
    switch (config.type) {
    case EncodingType::Empty:
        break;
    case EncodingType::Identity:
        config.scale = fields.number("scale", config.scale, {-1e6, 1e6});
        config.offset = fields.number("offset", config.offset, {-1e6, 1e6});
        break;
    case EncodingType::Frequency:
    case EncodingType::TriangleWave:
        config.frequencies = fields.integer("n_frequencies", config.frequencies, 1, 16);
        break;
    case EncodingType::OneBlob:
        config.bins = fields.integer("n_bins", config.bins, 1, 64);
        config.gaussian = fields.choice("kernel", config.gaussian, kKernelNames);
        break;
    case EncodingType::SphericalHarmonics:
        config.degree = fields.integer("degree", config.degree, 1, 4);
        break;
    default:
        readGrid(fields, config);
    }
    fields.finish();
    return config;
}

// Of a composite's parts, the inputs of one alone may be those that are left.
void requireClearDims(const std::vector<EncodingConfig>& parts, const std::string& file) {
    const auto isOpen = [](const EncodingConfig& part) { return part.dims == 0; };
    if (std::ranges::count_if(parts, isOpen) > 1)
        fail(ExitCode::BadData,
             "{}: encoding.nested: n_dims_to_encode may be 0 or missing in one part only, the one that takes "
             "the "
             "inputs that are left",
             file);
}

std::vector<EncodingConfig> readEncoding(const Json& json, const std::string& file) {
    JsonFields fields(json, file, "encoding");
    const Json* otype = fields.member("otype");
    if (!otype || *otype != "Composite") return {readPart(json, file, "encoding")};
    const Json* nested = fields.member("nested");
    fields.finish();
    if (!nested || !nested->is_array() || nested->empty() || nested->size() > kMaxParts)
        fields.refuse("nested", fmt::format("a list of 1 to {} encodings", kMaxParts));
    std::vector<EncodingConfig> parts;
    for (const Json& part : *nested)
        parts.push_back(readPart(part, file, fmt::format("encoding.nested[{}]", parts.size())));
    requireClearDims(parts, file);
    return parts;
}

NetworkConfig readNetwork(const Json& json, const std::string& file) {
    enum class NetworkType { FullyFused };
    enum class Activation { ReLU };
    constexpr EnumName<NetworkType> kTypes[] = {{NetworkType::FullyFused, "FullyFusedMLP"}};
    constexpr EnumName<Activation> kActivations[] = {{Activation::ReLU, "ReLU"}};
    JsonFields fields(json, file, "network");
    NetworkConfig config;
    fields.choice("otype", NetworkType::FullyFused, kTypes);
    fields.choice("activation", Activation::ReLU, kActivations);
    config.outputActivation =
        fields.choice("output_activation", config.outputActivation, kOutputActivationNames);
    config.width = fields.integer("n_neurons", config.width, {16, 32, 64, 128});
    config.hiddenLayers = fields.integer("n_hidden_layers", config.hiddenLayers, 1, 8);
    config.precision = fields.choice("precision", config.precision, kPrecisionNames);
    config.form = fields.choice("form", config.form, kFormNames);
    fields.finish();
    return config;
}

LossConfig readLoss(const Json& json, const std::string& file) {
    JsonFields fields(json, file, "loss");
    LossConfig config;
    config.type = typeOf(fields, kLossNames);
    if (config.type != LossType::L2) {
        config.epsilon = fields.number("epsilon", config.epsilon, {0, 1e6, NumberRange::LowOpen});
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
    config.learningRate = fields.number("learning_rate", config.learningRate, {0, 10});
    config.gridLearningRate = fields.number("grid_learning_rate", config.learningRate, {0, 10});
    config.beta1 = fields.number("beta1", config.beta1, {0, 1, NumberRange::HighOpen});
    config.beta2 = fields.number("beta2", config.beta2, {0, 1, NumberRange::HighOpen});
    config.epsilon = fields.number("epsilon", config.epsilon, {kSmallestAdamEpsilon, 1});
    config.l2 = fields.number("l2_reg", config.l2, {0, 1});
    config.clipNorm = fields.number("clip_norm", config.clipNorm, {0, 1e9});
    config.lossScale = fields.number("loss_scale", config.lossScale, {1, 1 << 20});
}

void readDecay(JsonFields& fields, OptimizerConfig& config) {
    config.decayStart = fields.integer("decay_start", config.decayStart, 0, UINT32_MAX);
    config.decayInterval = fields.integer("decay_interval", config.decayInterval, 0, UINT32_MAX);
    config.decayEnd = fields.integer("decay_end", config.decayEnd, 0, UINT32_MAX);
    config.decayBase = fields.number("decay_base", config.decayBase, {0, 1, NumberRange::LowOpen});
}

// Ema and ExponentialDecay, each at most once and in any order, around an Adam.
OptimizerConfig readOptimizer(const Json& json, const std::string& file) {
    OptimizerConfig config;
    std::vector<OptimizerType> met;
    std::string path = "optimizer";
    for (const Json* level = &json; level; path += ".nested") {
        JsonFields fields(*level, file, path);
        const OptimizerType type = typeOf(fields, kOptimizerNames);
        if (std::ranges::find(met, type) != met.end()) fields.refuse("otype", "another than those around it");
        met.push_back(type);
        if (type == OptimizerType::Adam) readAdam(fields, config);
        if (type == OptimizerType::Ema)
            config.emaDecay = fields.number("decay", config.emaDecay, {0, 1, NumberRange::HighOpen});
        if (type == OptimizerType::ExponentialDecay) readDecay(fields, config);
        level = type == OptimizerType::Adam ? nullptr : fields.member("nested");
        fields.finish();
        if (type != OptimizerType::Adam && !level)
            fields.refuse("nested", "an optimizer, in the end an Adam");
    }
    return config;
}

} // namespace

ModelConfig loadModelConfig(const std::filesystem::path& file) {
    requireFile(file);
    if (const uint64_t bytes = std::filesystem::file_size(file); bytes > kMaxJsonBytes)
        fail(ExitCode::BadData, "{}: {} bytes are too many, at most {} are read", file.string(), bytes,
             kMaxJsonBytes);
    const std::vector<uint8_t> bytes = readFile(file);
    return parseModelConfig({bytes.begin(), bytes.end()}, file.string());
}

ModelConfig parseModelConfig(const std::string& json, const std::string& name) {
    const Json root = parseJson(json, name);
    JsonFields fields(root, name, "");
    const Json* encoding = fields.member("encoding");
    const Json* network = fields.member("network");
    const Json* loss = fields.member("loss");
    const Json* optimizer = fields.member("optimizer");
    fields.finish();
    ModelConfig config;
    config.encoding = encoding ? readEncoding(*encoding, name) : std::vector{EncodingConfig{}};
    if (network) config.network = readNetwork(*network, name);
    if (loss) config.loss = readLoss(*loss, name);
    if (optimizer) config.optimizer = readOptimizer(*optimizer, name);
    return config;
}

} // namespace irradia
