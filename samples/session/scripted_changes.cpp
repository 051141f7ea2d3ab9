#include "samples/session/scripted_changes.h"

#include "engine/error.h"
#include "engine/scene/load_scene.h"
#include "nrc/learning/json_fields.h"
#include <algorithm>

namespace irradia {
namespace {

using Json = nlohmann::json;

constexpr double kMostRadiance = 1e20; // as of the scenes' own lamps
constexpr double kMostFactor = 1e9;

// What was asked for as `key`, and must be there.
const Json& required(JsonFields& fields, const std::string& key, const std::string& allowed) {
    const Json* value = fields.member(key);
    if (!value) fields.refuse(key, allowed);
    return *value;
}

glm::vec3 colour(const JsonFields& fields, const std::string& key, const Json& value, double most) {
    const auto isAllowed = [&](const Json& v) {
        return v.is_number() && v.get<double>() >= 0.0 && v.get<double>() <= most;
    };
    if (!value.is_array() || value.size() != 3 || !std::ranges::all_of(value, isAllowed))
        fields.refuse(key, fmt::format("three numbers from 0 to {:g}", most));
    return {value[0].get<float>(), value[1].get<float>(), value[2].get<float>()};
}

size_t materialIndex(JsonFields& fields, const std::string& key, const Scene& scene) {
    const std::string allowed =
        fmt::format("the name of a material, or an index below {}", scene.materials.size());
    const Json& value = required(fields, key, allowed);
    if (value.is_number_unsigned() && value.get<uint64_t>() < scene.materials.size())
        return value.get<size_t>();
    if (!value.is_string()) fields.refuse(key, allowed);
    const auto found = std::ranges::find(scene.materials, value.get<std::string>(), &Material::name);
    if (found == scene.materials.end()) fields.refuse(key, allowed);
    return static_cast<size_t>(found - scene.materials.begin());
}

SceneChange::Strength readStrength(const Json& json, const JsonFields& outer, const Scene& scene) {
    JsonFields fields(json, outer.file(), outer.pathOf("emissive_strength"));
    SceneChange::Strength strength{materialIndex(fields, "material", scene), 0.0f};
    if (!fields.has("value")) fields.refuse("value", fmt::format("a number from 0 to {:g}", kMostFactor));
    strength.value = static_cast<float>(fields.number("value", 0.0, {0.0, kMostFactor}));
    if (scene.materials[strength.material].emissiveFactor == glm::vec3(0.0f))
        fields.refuse("material", "a material with an emissiveFactor above 0");
    fields.finish();
    return strength;
}

SceneChange::Surface readSurface(const Json& json, const JsonFields& outer, const Scene& scene) {
    JsonFields fields(json, outer.file(), outer.pathOf("material"));
    SceneChange::Surface surface;
    surface.material = materialIndex(fields, "name", scene);
    const auto share = [&](const char* key) -> std::optional<float> {
        if (!fields.member(key)) return std::nullopt;
        return static_cast<float>(fields.number(key, 0.0, {0.0, 1.0}));
    };
    if (const Json* value = fields.member("base_color"))
        surface.baseColor = colour(fields, "base_color", *value, 1.0);
    surface.roughness = share("roughness");
    surface.metallic = share("metallic");
    fields.finish();
    return surface;
}

Environment readEnvironment(const Json& json, const JsonFields& fields, const Scene& scene) {
    Environment environment;
    if (!json.is_number()) {
        environment.constant = colour(fields, "environment", json, kMostRadiance);
        return environment;
    }
    const double factor = json.get<double>();
    if (!(factor >= 0.0 && factor <= kMostFactor))
        fields.refuse("environment", fmt::format("[r, g, b], or a factor from 0 to {:g}", kMostFactor));
    if (scene.environment.isBlack())
        fields.refuse("environment", "[r, g, b] where the scene has no environment to scale");
    environment = scene.environment;
    environment.constant *= static_cast<float>(factor);
    for (glm::vec3& texel : environment.texels) texel *= static_cast<float>(factor);
    return environment;
}

SceneChange readChange(const Json& json, const std::string& file, const std::string& path,
                       const Scene& scene) {
    JsonFields fields(json, file, path);
    SceneChange change;
    if (!fields.has("frame")) fields.refuse("frame", fmt::format("a whole number from 0 to {}", UINT32_MAX));
    change.frame = fields.integer("frame", 0, 0, UINT32_MAX);
    if (const Json* value = fields.member("emissive_strength"))
        change.strength = readStrength(*value, fields, scene);
    if (const Json* value = fields.member("material")) change.surface = readSurface(*value, fields, scene);
    if (const Json* value = fields.member("environment"))
        change.environment = readEnvironment(*value, fields, scene);
    if (const Json* value = fields.member("camera"))
        change.camera = parseCamera(*value, file, fields.pathOf("camera"), scene.origin);
    if (const Json* value = fields.member("restart")) {
        if (!value->is_boolean()) fields.refuse("restart", "true or false");
        change.restart = value->get<bool>();
    }
    fields.finish();
    return change;
}

} // namespace

void SceneChange::applyTo(Scene& scene) const {
    if (strength) {
        Material& material = scene.materials[strength->material];
        material.emission = strength->value * material.emissiveFactor;
    }
    if (surface) {
        Material& material = scene.materials[surface->material];
        material.baseColor = surface->baseColor.value_or(material.baseColor);
        material.roughness = surface->roughness.value_or(material.roughness);
        material.metallic = surface->metallic.value_or(material.metallic);
    }
    if (environment) scene.environment = *environment;
}

ScriptedChanges::ScriptedChanges(const std::filesystem::path& file, const Scene& scene)
    : file_(file.string()) {
    const Json json = loadJson(file);
    if (!json.is_array())
        fail(ExitCode::BadData, "{}: must be a list of changes, each an object with a frame", file_);
    for (const Json& entry : json) {
        changes_.push_back(readChange(entry, file_, fmt::format("changes[{}]", changes_.size()), scene));
        changes_.back().entry = changes_.size() - 1;
    }
    std::ranges::stable_sort(changes_, {}, &SceneChange::frame);
}

PlannedStates ScriptedChanges::states(const Scene& scene) const {
    // A scene without geometry: what is planned does not depend on it.
    Scene state;
    state.materials = scene.materials;
    state.images = scene.images;
    state.environment = scene.environment;
    PlannedStates states;
    for (const SceneChange& change : changes_) {
        change.applyTo(state);
        states.include(state);
    }
    return states;
}

void ScriptedChanges::requireBefore(uint32_t endFrame) const {
    for (const SceneChange& change : changes_)
        if (change.frame >= endFrame)
            fail(ExitCode::BadData, "{}: changes[{}].frame is {}, but the last frame rendered is {}", file_,
                 change.entry, change.frame, endFrame - 1);
}

std::span<const SceneChange> ScriptedChanges::takeUpTo(uint32_t frame) {
    const size_t first = taken_;
    while (taken_ < changes_.size() && changes_[taken_].frame <= frame) ++taken_;
    return std::span(changes_).subspan(first, taken_ - first);
}

} // namespace irradia
