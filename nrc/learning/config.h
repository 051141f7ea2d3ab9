// A model as JSON describes it, with tiny-cuda-nn's keys: encoding, network, loss, optimizer.
//
//     {"encoding": {"otype": "HashGrid", "n_levels": 8, ...},
//      "network": {"otype": "FullyFusedMLP", "n_neurons": 64, ...},
//      "loss": {"otype": "RelativeL2Luminance", "epsilon": 0.01},
//      "optimizer": {"otype": "Ema", "decay": 0.99, "nested": {"otype": "Adam", ...}}}
//
// A model says what it is: a key may be left out only where the struct's comment, or the encoding's file in
// nrc/learning/encodings, says what that means.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace irradia {

// One encoding of a composite, over consecutive inputs. nrc/learning/encodings says which there are, and
// which keys each takes beside these.
struct EncodingConfig {
    std::string otype;
    uint32_t dims = 0; // n_dims_to_encode; 0 or left out = all inputs that are left, in one part at most
    std::map<std::string, double> keys{}; // all that it takes; a choice's value is the place of its name

    // Throw Error(Internal) where the encoding takes no such key.
    double number(const std::string& key) const;
    uint32_t whole(const std::string& key) const { return static_cast<uint32_t>(number(key)); }

    bool operator==(const EncodingConfig&) const = default;
};

// An encoding whose other keys have their usual values. Ranges are not checked. Throws Error(Internal) where
// it is unknown or takes no such key.
EncodingConfig makeEncoding(const std::string& otype, uint32_t dims = 0,
                            std::map<std::string, double> keys = {});

enum class Precision { Float, Half };
enum class NetworkForm { Auto, Subgroup, Workgroup }; // Auto: by device class (CPU: subgroup, GPU: workgroup)
enum class OutputActivation { None, ReLU, Exponential, Softplus };

struct NetworkConfig {
    uint32_t width = 64;       // n_neurons: 16, 32, 64 or 128
    uint32_t hiddenLayers = 5; // n_hidden_layers, 1 to 8
    // What follows may be left out, as may the only "otype" and "activation" there are.
    OutputActivation outputActivation = OutputActivation::None;
    // "precision": "Float" or "Half", of weights and activations; sums are single.
    Precision precision = Precision::Float;
    NetworkForm form = NetworkForm::Auto; // "form": "Auto", "Subgroup", "Workgroup"

    bool operator==(const NetworkConfig&) const = default;
};

enum class LossType { L2, RelativeL2, RelativeL2Luminance };

struct LossConfig {
    LossType type = LossType::L2;
    double epsilon = 0.01; // added to the squared prediction of relative losses
    // The denominator is raised to a power that goes linearly from exponentStart to exponentEnd over the
    // steps [annealStart, annealEnd]: 1 (where left out) = relative, 0 = plain L2.
    double exponentStart = 1.0;
    double exponentEnd = 1.0;
    uint32_t annealStart = 0;
    uint32_t annealEnd = 0;

    bool operator==(const LossConfig&) const = default;
};

struct OptimizerConfig {
    double learningRate = 1e-2;     // of the network's weights
    double gridLearningRate = 1e-2; // "grid_learning_rate" of the features; left out = as learning_rate
    double beta1 = 0.9;
    double beta2 = 0.99;
    double epsilon = 1e-8;
    double l2 = 1e-6;               // "l2_reg", of the network's weights alone
    double emaDecay = 0.0;          // Ema "decay": alpha in [0, 1); 0, or no Ema = the weights themselves
    uint32_t decayStart = 0;        // ExponentialDecay: the rate is multiplied by decayBase
    uint32_t decayInterval = 0;     // every decayInterval steps (0, or no ExponentialDecay = never)
    uint32_t decayEnd = UINT32_MAX; // start and end left out = from the first step on, without end
    double decayBase = 1.0;
    double clipNorm = 0.0; // "clip_norm": largest norm of the gradient; 0 or left out = no clip
    // "loss_scale", half precision only, left out = 1: brings gradients of a record's own loss into the
    // middle of 6e-8 to 4096, beyond which they vanish or are cut.
    double lossScale = 1.0;

    bool operator==(const OptimizerConfig&) const = default;
};

struct ModelConfig {
    std::vector<EncodingConfig> encoding;
    NetworkConfig network;
    LossConfig loss;
    OptimizerConfig optimizer;

    bool operator==(const ModelConfig&) const = default;
};

// Throws Error: NotFound, or BadData naming the file and the key that is unknown, missing or out of range.
ModelConfig loadModelConfig(const std::filesystem::path& file);
ModelConfig parseModelConfig(const std::string& json, const std::string& name);
// What stands at `path` of the file `name`, empty for the file itself.
ModelConfig readModelConfig(const nlohmann::json& json, const std::string& name, const std::string& path);

// The same as JSON with every key, for files that record it; parseModelConfig gives it back.
nlohmann::ordered_json modelJson(const ModelConfig& config);
std::string toJson(const ModelConfig& config);

// "FullyFusedMLP 64x5", for messages.
std::string describe(const NetworkConfig& config);
std::string describe(OutputActivation activation);
std::string describe(const std::vector<EncodingConfig>& parts); // as one line of JSON

} // namespace irradia
