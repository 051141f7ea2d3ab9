#include "nrc/renderer/nrc_config.h"

#include "engine/error.h"
#include "nrc/learning/json_fields.h"
#include "nrc/renderer/preset_base.h"
#include <cmath>
#include <limits>

namespace irradia {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

constexpr EnumName<Weights> kWeightsNames[] = {{Weights::Ema, "Ema"}, {Weights::Raw, "Raw"}};
constexpr EnumName<bool> kSwitchNames[] = {{true, "on"}, {false, "off"}};
constexpr NumberRange kShare{0, 1};
constexpr NumberRange kDecay{0, 1, NumberRange::HighOpen};

float single(double number) {
    return static_cast<float>(number);
}

// A threshold of the area spread; "never" is infinite, and what is negative is exceeded at the first vertex.
float readSpread(JsonFields& fields, const std::string& key) {
    const Json* value = fields.member(key);
    if (value && *value == "never") return std::numeric_limits<float>::infinity();
    if (!value || !value->is_number()) fields.refuse(key, "a number, or \"never\"");
    return single(fields.number(key, {-1, 1e9}));
}

void readPaths(const Json& json, const std::string& file, NrcConfig& config) {
    JsonFields fields(json, file, "paths");
    config.spread = readSpread(fields, "spread");
    config.trainingSpread =
        fields.member("training_spread") ? readSpread(fields, "training_spread") : config.spread;
    config.endDepth = fields.integer("end_depth", config.endDepth, 0, gpu::kNoDepth);
    config.unbiasedShare = single(fields.number("unbiased_share", kShare));
    config.suffixBounces = fields.integer("suffix_bounces", 1, 1024);
    config.residualShare = single(fields.number("residual_share", config.residualShare, kShare));
    fields.finish();
}

void readTraining(const Json& json, const std::string& file, NrcConfig& config) {
    JsonFields fields(json, file, "training");
    config.recordsAt1080p = fields.integer("records", 1, 1u << 22);
    config.minRecords = fields.integer("min_records", 1, 1u << 20);
    config.steps = fields.integer("steps", 1, 64);
    config.selfTraining = fields.choice("self_training", kWeightsNames);
    config.uniformShare = single(fields.number("uniform_share", config.uniformShare, kShare));
    fields.finish();
}

void readAdaptation(JsonFields& outer, const std::string& file, AdaptationConfig& config) {
    const Json* json = outer.member("adaptation");
    config.on = json && *json != "off";
    if (json && !config.on) return;
    if (!json || !json->is_object()) outer.refuse("adaptation", "an object, or \"off\"");
    JsonFields fields(*json, file, "adaptation");
    config.smoothing = single(fields.number("smoothing", kDecay));
    const double threshold = fields.number("threshold", {0, 100});
    config.threshold = single(threshold);
    config.full = single(fields.number("full", {threshold, 100}));
    config.mostSteps = fields.integer("most_steps", 1, 64);
    config.shortestEma = single(fields.number("shortest_ema", kDecay));
    config.calming = single(fields.number("calming", kDecay));
    config.youth = fields.integer("youth", 0, 1u << 20);
    config.settling = fields.integer("settling", 0, 1u << 20);
    fields.finish();
}

NrcConfig readNrcConfig(const Json& json, const std::string& file) {
    NrcConfig config;
    JsonFields fields(json, file, "");
    readPaths(fields.section("paths"), file, config);
    readTraining(fields.section("training"), file, config);
    readAdaptation(fields, file, config.adaptation);
    config.factorise = fields.choice("factorise", kSwitchNames);
    config.shown = fields.choice("shown", kWeightsNames);
    config.model = readModelConfig(fields.section("model"), file, "model");
    fields.finish();
    return config;
}

// The shortest decimal that is this number in single precision; "never" where it is infinite.
OrderedJson decimal(float number) {
    if (std::isinf(number)) return "never";
    return std::stod(fmt::format("{}", number));
}

OrderedJson adaptationJson(const AdaptationConfig& config) {
    if (!config.on) return "off";
    return {{"smoothing", decimal(config.smoothing)},
            {"threshold", decimal(config.threshold)},
            {"full", decimal(config.full)},
            {"most_steps", config.mostSteps},
            {"shortest_ema", decimal(config.shortestEma)},
            {"calming", decimal(config.calming)},
            {"youth", config.youth},
            {"settling", config.settling}};
}

} // namespace

NrcConfig parseNrcConfig(const std::string& text, const std::string& name) {
    return readNrcConfig(presetWithBase(parseJson(text, name), name), name);
}

NrcConfig loadNrcConfig(const std::filesystem::path& file) {
    return readNrcConfig(presetWithBase(loadJson(file), file.string()), file.string());
}

NrcConfig nrcPreset(const std::string& name) {
    return readNrcConfig(nrcPresetJson(name), "preset " + name);
}

ModelConfig parseCacheModel(const std::string& text, const std::string& name) {
    return readModelConfig(modelWithBase(parseJson(text, name), name), name, "");
}

ModelConfig loadCacheModel(const std::filesystem::path& file) {
    return readModelConfig(modelWithBase(loadJson(file), file.string()), file.string(), "");
}

std::string toJson(const NrcConfig& config) {
    OrderedJson paths{{"spread", decimal(config.spread)},
                      {"training_spread", decimal(config.trainingSpread)},
                      {"unbiased_share", decimal(config.unbiasedShare)},
                      {"suffix_bounces", config.suffixBounces},
                      {"residual_share", decimal(config.residualShare)}};
    if (config.endDepth != gpu::kNoDepth) paths["end_depth"] = config.endDepth;
    const OrderedJson training{{"records", config.recordsAt1080p},
                               {"min_records", config.minRecords},
                               {"steps", config.steps},
                               {"self_training", nameOf(kWeightsNames, config.selfTraining)},
                               {"uniform_share", decimal(config.uniformShare)}};
    return OrderedJson{{"paths", paths},
                       {"training", training},
                       {"adaptation", adaptationJson(config.adaptation)},
                       {"factorise", nameOf(kSwitchNames, config.factorise)},
                       {"shown", nameOf(kWeightsNames, config.shown)},
                       {"model", modelJson(config.model)}}
        .dump(2);
}

} // namespace irradia
