#include "nrc/renderer/nrc_config.h"

#include "engine/error.h"
#include "engine/image/read_file.h"
#include "nrc/json_fields.h"
#include "nrc/renderer/presets.h"
#include <algorithm>
#include <fmt/ranges.h>
#include <limits>

namespace irradia {
namespace {

using Json = nlohmann::json;

constexpr EnumName<Weights> kWeightsNames[] = {{Weights::Ema, "Ema"}, {Weights::Raw, "Raw"}};
constexpr EnumName<bool> kSwitchNames[] = {{true, "on"}, {false, "off"}};

// A threshold of the area spread; "never" is infinite, and what is negative is exceeded at the first vertex.
float readSpread(JsonFields& fields, const std::string& key, float fallback) {
    const Json* value = fields.member(key);
    if (value && *value == "never") return std::numeric_limits<float>::infinity();
    if (value && !value->is_number()) fields.refuse(key, "a number, or \"never\"");
    return static_cast<float>(fields.number(key, fallback, {-1, 1e9}));
}

void readPaths(const Json& json, const std::string& file, NrcConfig& config) {
    JsonFields fields(json, file, "paths");
    config.spread = readSpread(fields, "spread", config.spread);
    config.trainingSpread = readSpread(fields, "training_spread", config.spread);
    config.endDepth = fields.integer("end_depth", config.endDepth, 0, gpu::kNoDepth);
    config.unbiasedShare = static_cast<float>(fields.number("unbiased_share", config.unbiasedShare, {0, 1}));
    config.suffixBounces = fields.integer("suffix_bounces", config.suffixBounces, 1, 1024);
    config.residualShare = static_cast<float>(fields.number("residual_share", config.residualShare, {0, 1}));
    fields.finish();
}

void readTraining(const Json& json, const std::string& file, NrcConfig& config) {
    JsonFields fields(json, file, "training");
    config.recordsAt1080p = fields.integer("records", config.recordsAt1080p, 1, 1u << 22);
    config.minRecords = fields.integer("min_records", config.minRecords, 1, 1u << 20);
    config.steps = fields.integer("steps", config.steps, 1, 64);
    config.selfTraining = fields.choice("self_training", config.selfTraining, kWeightsNames);
    config.uniformShare = static_cast<float>(fields.number("uniform_share", config.uniformShare, {0, 1}));
    fields.finish();
}

// "on" and "off", or the settings of what is on.
void readAdaptation(JsonFields& outer, const std::string& file, AdaptationConfig& config) {
    const Json* json = outer.member("adaptation");
    if (json && json->is_string()) config.on = outer.choice("adaptation", config.on, kSwitchNames);
    if (!json || json->is_string()) return;
    JsonFields fields(*json, file, "adaptation");
    config.smoothing =
        static_cast<float>(fields.number("smoothing", config.smoothing, {0, 1, NumberRange::HighOpen}));
    config.threshold = static_cast<float>(fields.number("threshold", config.threshold, {0, 100}));
    config.full = static_cast<float>(fields.number("full", config.full, {config.threshold, 100}));
    config.mostSteps = fields.integer("most_steps", config.mostSteps, 1, 64);
    config.shortestEma =
        static_cast<float>(fields.number("shortest_ema", config.shortestEma, {0, 1, NumberRange::HighOpen}));
    config.calming =
        static_cast<float>(fields.number("calming", config.calming, {0, 1, NumberRange::HighOpen}));
    config.youth = fields.integer("youth", config.youth, 0, 1u << 20);
    config.settling = fields.integer("settling", config.settling, 0, 1u << 20);
    fields.finish();
}

} // namespace

NrcConfig parseNrcConfig(const std::string& text, const std::string& name) {
    NrcConfig config;
    const Json json = parseJson(text, name);
    JsonFields fields(json, name, "");
    if (const Json* paths = fields.member("paths")) readPaths(*paths, name, config);
    if (const Json* training = fields.member("training")) readTraining(*training, name, config);
    readAdaptation(fields, name, config.adaptation);
    config.factorise = fields.choice("factorise", config.factorise, kSwitchNames);
    config.shown = fields.choice("shown", config.shown, kWeightsNames);
    const Json* model = fields.member("model");
    fields.finish();
    config.model = model ? parseModelConfig(model->dump(), name) : nrcPreset("faithful").model;
    return config;
}

NrcConfig loadNrcConfig(const std::filesystem::path& file) {
    const auto bytes = readFile(file);
    return parseNrcConfig(std::string(bytes.begin(), bytes.end()), file.string());
}

NrcConfig nrcPreset(const std::string& name) {
    for (const auto& [presetName, text] : kPresets)
        if (name == presetName) return parseNrcConfig(text, "preset " + name);
    fail(ExitCode::Usage, "there is no preset {}; there are {}", name, fmt::join(nrcPresetNames(), ", "));
}

std::vector<std::string> nrcPresetNames() {
    std::vector<std::string> names;
    for (const auto& preset : kPresets) names.emplace_back(preset.name);
    return names;
}

} // namespace irradia
