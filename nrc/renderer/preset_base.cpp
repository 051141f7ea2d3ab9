#include "nrc/renderer/preset_base.h"

#include "engine/error.h"
#include "nrc/learning/json_fields.h"
#include "nrc/renderer/nrc_config.h"
#include "nrc/renderer/presets.h"
#include <algorithm>
#include <fmt/ranges.h>

namespace irradia {
namespace {

using Json = nlohmann::json;

bool isOfAnotherType(const Json& own, const Json& base) {
    return own.contains("otype") && base.contains("otype") && own["otype"] != base["otype"];
}

Json merged(const Json& base, const Json& own) {
    if (!own.is_object() || !base.is_object() || isOfAnotherType(own, base)) return own;
    Json both = base;
    for (const auto& [key, value] : own.items())
        both[key] = base.contains(key) ? merged(base[key], value) : value;
    return both;
}

// Takes "base" out of `own`; null where there is none.
Json takeBase(Json& own, const std::string& file) {
    if (!own.is_object() || !own.contains("base")) return nullptr;
    const Json base = own["base"];
    const std::vector<std::string> names = nrcPresetNames();
    if (!base.is_string() || std::ranges::find(names, base.get<std::string>()) == names.end())
        JsonFields(own, file, "").refuse("base", fmt::format("one of {}", fmt::join(names, ", ")));
    own.erase("base");
    return nrcPresetJson(base.get<std::string>());
}

// What nobody gives is refused where it is read; here, that it might have been inherited.
void requireWhole(const Json& json, const std::string& file, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
        if (json.is_object() && !json.contains(key))
            fail(ExitCode::BadData,
                 "{}: {} is missing, and no \"base\" names a preset to inherit it from ({})", file, key,
                 fmt::join(nrcPresetNames(), ", "));
}

} // namespace

std::vector<std::string> nrcPresetNames() {
    std::vector<std::string> names;
    for (const auto& preset : kPresets) names.emplace_back(preset.name);
    return names;
}

Json nrcPresetJson(const std::string& name) {
    for (const auto& [presetName, text] : kPresets)
        if (name == presetName) return presetWithBase(parseJson(text, "preset " + name), "preset " + name);
    fail(ExitCode::Usage, "there is no preset {}; there are {}", name, fmt::join(nrcPresetNames(), ", "));
}

Json presetWithBase(Json own, const std::string& file) {
    const Json base = takeBase(own, file);
    if (!base.is_null()) return merged(base, own);
    requireWhole(own, file, {"paths", "training", "adaptation", "factorise", "shown", "model"});
    return own;
}

Json modelWithBase(Json own, const std::string& file) {
    const Json base = takeBase(own, file);
    if (!base.is_null()) return merged(base["model"], own);
    requireWhole(own, file, {"encoding", "network", "loss", "optimizer"});
    return own;
}

} // namespace irradia
