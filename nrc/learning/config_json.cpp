// A model's configuration as the text that parseModelConfig reads.
#include "nrc/learning/config_names.h"
#include "nrc/learning/encodings/table.h"
#include <fmt/format.h>

namespace irradia {
namespace {

using Json = nlohmann::ordered_json;

Json partJson(const EncodingConfig& config) {
    Json json{{"otype", config.otype}, {"n_dims_to_encode", config.dims}};
    for (const EncodingKey& key : encodingKind(config.otype).keys)
        json[key.name] = key.write(config.number(key.name));
    return json;
}

Json encodingJson(const std::vector<EncodingConfig>& parts) {
    if (parts.size() == 1) return partJson(parts.front());
    Json nested = Json::array();
    for (const EncodingConfig& part : parts) nested.push_back(partJson(part));
    return {{"otype", "Composite"}, {"nested", nested}};
}

Json networkJson(const NetworkConfig& config) {
    return {{"otype", "FullyFusedMLP"},
            {"activation", "ReLU"},
            {"output_activation", nameOf(kOutputActivationNames, config.outputActivation)},
            {"n_neurons", config.width},
            {"n_hidden_layers", config.hiddenLayers},
            {"precision", nameOf(kPrecisionNames, config.precision)},
            {"form", nameOf(kFormNames, config.form)}};
}

Json lossJson(const LossConfig& config) {
    Json json{{"otype", nameOf(kLossNames, config.type)}};
    if (config.type == LossType::L2) return json;
    json["epsilon"] = config.epsilon;
    json["exponent"] = Json::array({config.exponentStart, config.exponentEnd});
    json["anneal"] = Json::array({config.annealStart, config.annealEnd});
    return json;
}

Json optimizerJson(const OptimizerConfig& config) {
    const Json adam{{"otype", "Adam"},
                    {"learning_rate", config.learningRate},
                    {"grid_learning_rate", config.gridLearningRate},
                    {"beta1", config.beta1},
                    {"beta2", config.beta2},
                    {"epsilon", config.epsilon},
                    {"l2_reg", config.l2},
                    {"clip_norm", config.clipNorm},
                    {"loss_scale", config.lossScale}};
    const Json decay{{"otype", "ExponentialDecay"},
                     {"decay_start", config.decayStart},
                     {"decay_interval", config.decayInterval},
                     {"decay_end", config.decayEnd},
                     {"decay_base", config.decayBase},
                     {"nested", adam}};
    return {{"otype", "Ema"}, {"decay", config.emaDecay}, {"nested", decay}};
}

} // namespace

Json modelJson(const ModelConfig& config) {
    return {{"encoding", encodingJson(config.encoding)},
            {"network", networkJson(config.network)},
            {"loss", lossJson(config.loss)},
            {"optimizer", optimizerJson(config.optimizer)}};
}

std::string toJson(const ModelConfig& config) {
    return modelJson(config).dump(2);
}

std::string describe(const NetworkConfig& config) {
    return fmt::format("FullyFusedMLP {}x{}", config.width, config.hiddenLayers);
}

std::string describe(OutputActivation activation) {
    return std::string(nameOf(kOutputActivationNames, activation));
}

std::string describe(const std::vector<EncodingConfig>& parts) {
    return encodingJson(parts).dump();
}

} // namespace irradia
