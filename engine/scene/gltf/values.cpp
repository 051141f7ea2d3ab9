#include "engine/scene/gltf/values.h"

#include <algorithm>
#include <cmath>

namespace irradia::gltf {

Extension findExtension(const tinygltf::ExtensionMap& extensions, const std::string& name) {
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

const tinygltf::Value& member(const tinygltf::Value& object, std::string_view key) {
    static const tinygltf::Value kNone;
    return object.IsObject() ? object.Get(std::string(key)) : kNone;
}

double plainNumber(const tinygltf::Value& object, const std::string& key, double otherwise) {
    const tinygltf::Value& value = member(object, key);
    return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

std::vector<double> numbers(const tinygltf::Value& object, const std::string& key) {
    std::vector<double> values;
    const tinygltf::Value& array = member(object, key);
    for (size_t i = 0; i < array.ArrayLen(); ++i) {
        const tinygltf::Value& value = array.Get(static_cast<int>(i));
        if (!value.IsNumber()) return {};
        values.push_back(value.GetNumberAsDouble());
    }
    return values;
}

float Values::number(const std::string& key, double value, double low, double high) const {
    const double clamped = std::isnan(value) ? low : std::clamp(value, low, high);
    if (clamped != value)
        source_.note(
            Severity::Warning, owner_.pointer, "VALUE_NOT_IN_RANGE",
            fmt::format("{}: {} {} is outside {} to {} and was clamped", owner_.name, key, value, low, high));
    return static_cast<float>(clamped);
}

glm::vec3 Values::colour(const std::string& key, const std::vector<double>& values, double high) const {
    return {number(key, values[0], 0, high), number(key, values[1], 0, high),
            number(key, values[2], 0, high)};
}

glm::vec3 Values::colour(const tinygltf::Value& object, const std::string& key, double high) const {
    const std::vector<double> values = numbers(object, key);
    return values.size() < 3 ? glm::vec3(1.0f) : colour(key, values, high);
}

} // namespace irradia::gltf
