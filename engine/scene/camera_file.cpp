#include "engine/error.h"
#include "engine/scene/gltf/json_guard.h"
#include "engine/scene/load_scene.h"
#include "engine/scene/scene_box.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

using Json = nlohmann::json;

// "camera.json: camera.position" for errors.
struct Field {
    const std::string& file;
    std::string name;

    [[noreturn]] void refuse(const std::string& need) const {
        fail(ExitCode::BadData, "{}: '{}' must be {}", file, name, need);
    }
};

glm::dvec3 vector(const Json& value, const Field& field) {
    if (!value.is_array() || value.size() != 3) field.refuse("three numbers");
    glm::dvec3 result;
    for (int c = 0; c < 3; ++c) {
        if (!value[c].is_number()) field.refuse("three numbers");
        result[c] = value[c].get<double>();
        if (std::abs(result[c]) > 1e30) field.refuse("three numbers below 1e30");
    }
    return result;
}

// A path beside the file, a colour as "r,g,b", or nothing.
std::string readEnvironment(const Json& value, const std::filesystem::path& file) {
    if (value.is_null()) return {};
    if (value.is_string()) return (file.parent_path() / value.get<std::string>()).string();
    const glm::dvec3 colour = vector(value, {file.string(), "env"});
    return fmt::format("{},{},{}", colour.x, colour.y, colour.z);
}

// "camera 0 'front', 1, 2 and 7 more".
std::string cameraNames(const Scene& scene) {
    constexpr size_t kMostNames = 16;
    std::string names;
    for (size_t i = 0; i < std::min(scene.cameras.size(), kMostNames); ++i) {
        const std::string& name = scene.cameras[i].name;
        names += (i == 0 ? "camera " : ", ") + std::to_string(i) + (name.empty() ? "" : " '" + name + "'");
    }
    if (scene.cameras.size() > kMostNames)
        names += fmt::format(" and {} more", scene.cameras.size() - kMostNames);
    return names.empty() ? "no camera" : names;
}

void requireKnownKeys(const Json& camera, const std::string& file, const std::string& path) {
    constexpr const char* kKeys[] = {"position", "look_at", "up", "vfov_deg", "aspect"};
    for (const auto& [key, value] : camera.items())
        if (std::ranges::find(kKeys, key) == std::end(kKeys))
            fail(ExitCode::BadData, "{}: unknown key {}, there are {} in '{}'", file, Json(key).dump(),
                 fmt::join(kKeys, ", "), path);
}

} // namespace

Camera parseCamera(const Json& json, const std::string& file, const std::string& path,
                   const glm::dvec3& origin) {
    const auto member = [&](const std::string& key) -> const Json& {
        if (!json.contains(key)) fail(ExitCode::BadData, "{}: '{}.{}' is missing", file, path, key);
        return json[key];
    };
    const auto refuse = [&](const std::string& key, const std::string& need) {
        Field{file, path + "." + key}.refuse(need);
    };
    const auto read = [&](const std::string& key) { return vector(member(key), {file, path + "." + key}); };
    if (!json.is_object()) Field{file, path}.refuse("an object");
    requireKnownKeys(json, file, path);
    const glm::dvec3 position = read("position");
    const glm::dvec3 forward = read("look_at") - position;
    const glm::dvec3 right = glm::cross(forward, json.contains("up") ? read("up") : glm::dvec3(0, 1, 0));
    if (!(glm::length(forward) > 0)) refuse("look_at", "another point than the position");
    if (!(glm::length(right) > 1e-9 * glm::length(forward))) refuse("up", "a direction across the view");
    const Json& fov = member("vfov_deg");
    if (!fov.is_number() || !(fov.get<double>() > 1e-4 && fov.get<double>() < 180))
        refuse("vfov_deg", "an angle between 0 and 180 degrees");

    Camera camera;
    camera.name = std::filesystem::path(file).stem().string();
    camera.position = position - origin;
    camera.forward = glm::normalize(forward);
    camera.up = glm::normalize(glm::cross(right, forward));
    camera.verticalFov = static_cast<float>(glm::radians(fov.get<double>()));
    return camera;
}

CameraFile loadCameraFile(const std::filesystem::path& file, const glm::dvec3& origin) {
    const gltf::SourceFile source = gltf::openSource(file);
    const char* text = reinterpret_cast<const char*>(source.bytes.data());
    gltf::guardJson(source, {text, source.bytes.size()}, gltf::Schema::Any);
    const Json json = Json::parse(text, text + source.bytes.size());
    if (!json.is_object() || !json.contains("camera") || !json["camera"].is_object())
        fail(ExitCode::BadData, "{}: there is no object 'camera'", file.string());
    return {parseCamera(json["camera"], file.string(), "camera", origin),
            json.contains("env") ? readEnvironment(json["env"], file) : std::string()};
}

CameraFile chooseCamera(const Scene& scene, const std::string& choice) {
    if (choice.empty())
        return {scene.cameras.empty() ? framingCamera(sceneBox(scene)) : scene.cameras.front(), {}};
    if (choice.ends_with(".json")) return loadCameraFile(choice, scene.origin);
    const auto named = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                    [&](const Camera& camera) { return camera.name == choice; });
    if (named != scene.cameras.end()) return {*named, {}};
    size_t index = 0;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
    if (error == std::errc() && end == choice.data() + choice.size() && index < scene.cameras.size())
        return {scene.cameras[index], {}};
    fail(ExitCode::NotFound, "camera '{}': the scene '{}' has {}", choice, scene.name, cameraNames(scene));
}

} // namespace irradia
