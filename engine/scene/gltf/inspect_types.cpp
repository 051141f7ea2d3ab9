#include "engine/scene/gltf/glb.h"
#include "engine/scene/gltf/inspect.h"
#include <algorithm>
#include <nlohmann/json.hpp>

namespace irradia::gltf {
namespace {

using Json = nlohmann::json;

// Index: a number, of which the guard has seen to all but arrays and objects.
enum class Kind { Number, Index, Boolean, Text, Object, Array, Numbers };

const char* nameOf(Kind kind) {
    switch (kind) {
    case Kind::Number:
    case Kind::Index:
        return "number";
    case Kind::Boolean:
        return "boolean";
    case Kind::Text:
        return "text";
    case Kind::Object:
        return "object";
    case Kind::Array:
        return "array";
    default:
        return "array of numbers";
    }
}

struct Expected {
    std::string_view path; // of members, * for any and for every element of an array
    std::vector<std::string_view> names;
    Kind kind;
};

// What the reader takes for absent where it is of another type. What it refuses has its place elsewhere:
// integers in the guard, texture infos and cameras in explain.cpp.
const Expected kExpected[] = {
    {"materials/*", {"alphaCutoff"}, Kind::Number},
    {"materials/*", {"doubleSided"}, Kind::Boolean},
    {"materials/*", {"name", "alphaMode"}, Kind::Text},
    {"materials/*", {"pbrMetallicRoughness", "extensions"}, Kind::Object},
    {"materials/*", {"emissiveFactor"}, Kind::Numbers},
    {"materials/*/pbrMetallicRoughness", {"metallicFactor", "roughnessFactor"}, Kind::Number},
    {"materials/*/pbrMetallicRoughness", {"baseColorFactor"}, Kind::Numbers},
    {"materials/*/normalTexture", {"scale"}, Kind::Number},
    {"materials/*/extensions", {"*"}, Kind::Object},
    {"materials/*/extensions/KHR_materials_emissive_strength", {"emissiveStrength"}, Kind::Number},
    {"materials/*/extensions/KHR_materials_ior", {"ior"}, Kind::Number},
    {"materials/*/extensions/KHR_materials_specular", {"specularFactor"}, Kind::Number},
    {"materials/*/extensions/KHR_materials_specular", {"specularColorFactor"}, Kind::Numbers},
    {"materials/*/extensions/KHR_materials_specular",
     {"specularTexture", "specularColorTexture"},
     Kind::Object},
    {"materials/*/extensions/KHR_materials_transmission", {"transmissionFactor"}, Kind::Number},
    {"materials/*/extensions/KHR_materials_transmission", {"transmissionTexture"}, Kind::Object},
    {"materials/*/extensions/KHR_materials_volume", {"thicknessFactor", "attenuationDistance"}, Kind::Number},
    {"materials/*/extensions/KHR_materials_volume", {"attenuationColor"}, Kind::Numbers},
    {"materials/*/extensions/KHR_materials_pbrSpecularGlossiness", {"glossinessFactor"}, Kind::Number},
    {"materials/*/extensions/KHR_materials_pbrSpecularGlossiness",
     {"diffuseFactor", "specularFactor"},
     Kind::Numbers},
    {"materials/*/extensions/KHR_materials_pbrSpecularGlossiness",
     {"diffuseTexture", "specularGlossinessTexture"},
     Kind::Object},
    {"materials/*/*/extensions", {"KHR_texture_transform"}, Kind::Object},
    {"materials/*/*/extensions/KHR_texture_transform", {"offset", "scale"}, Kind::Numbers},
    {"materials/*/*/extensions/KHR_texture_transform", {"rotation"}, Kind::Number},
    {"materials/*/*/*/extensions", {"KHR_texture_transform"}, Kind::Object},
    {"materials/*/*/*/extensions/KHR_texture_transform", {"offset", "scale"}, Kind::Numbers},
    {"materials/*/*/*/extensions/KHR_texture_transform", {"rotation"}, Kind::Number},
    {"materials/*/extensions/*/*/extensions", {"KHR_texture_transform"}, Kind::Object},
    {"materials/*/extensions/*/*/extensions/KHR_texture_transform", {"offset", "scale"}, Kind::Numbers},
    {"materials/*/extensions/*/*/extensions/KHR_texture_transform", {"rotation"}, Kind::Number},
    {"nodes/*", {"name"}, Kind::Text},
    {"nodes/*", {"translation", "rotation", "scale", "matrix", "weights"}, Kind::Numbers},
    {"nodes/*", {"mesh", "camera", "skin"}, Kind::Index},
    {"nodes/*", {"children"}, Kind::Numbers},
    {"nodes/*", {"extensions"}, Kind::Object},
    {"nodes/*/extensions", {"*"}, Kind::Object},
    {"nodes/*/extensions/KHR_lights_punctual", {"light"}, Kind::Index},
    {"nodes/*/extensions/EXT_mesh_gpu_instancing", {"attributes"}, Kind::Object},
    {"meshes/*", {"weights"}, Kind::Numbers},
    {"meshes/*", {"primitives"}, Kind::Array},
    {"meshes/*/primitives/*", {"indices", "material", "mode"}, Kind::Index},
    {"meshes/*/primitives/*", {"targets"}, Kind::Array},
    {"meshes/*/primitives/*", {"extensions"}, Kind::Object},
    {"meshes/*/primitives/*/extensions", {"*"}, Kind::Object},
    {"accessors/*", {"normalized"}, Kind::Boolean},
    {"accessors/*", {"bufferView", "byteOffset"}, Kind::Index},
    {"bufferViews/*", {"byteOffset", "byteStride"}, Kind::Index},
    {"bufferViews/*", {"extensions"}, Kind::Object},
    {"bufferViews/*/extensions", {"*"}, Kind::Object},
    {"bufferViews/*/extensions/EXT_meshopt_compression", {"mode", "filter"}, Kind::Text},
    {"textures/*", {"source", "sampler"}, Kind::Index},
    {"textures/*", {"extensions"}, Kind::Object},
    {"textures/*/extensions", {"*"}, Kind::Object},
    {"cameras/*/perspective", {"aspectRatio", "zfar"}, Kind::Number},
    {"scenes/*", {"nodes"}, Kind::Numbers},
    {"", {"scene"}, Kind::Index},
    {"", {"extensions"}, Kind::Object},
    {"extensions", {"*"}, Kind::Object},
    {"extensions/KHR_lights_punctual/lights/*", {"intensity", "range"}, Kind::Number},
    {"extensions/KHR_lights_punctual/lights/*", {"color"}, Kind::Numbers},
    {"extensions/KHR_lights_punctual/lights/*/spot", {"innerConeAngle", "outerConeAngle"}, Kind::Number},
};

class TypeInspection {
public:
    explicit TypeInspection(const SourceFile& source)
        : source_(source)
        , json_(Json::parse(jsonText(source))) {}

    void inspectAll() const {
        for (const Expected& expected : kExpected) descend(json_, {}, expected.path, expected);
    }

private:
    // From a value along the rest of the path to those that the members belong to.
    void descend(const Json& json, const Thing& at, std::string_view path, const Expected& expected) const {
        if (path.empty()) return inspectMembers(json, at, expected);
        const size_t end = std::min(path.find('/'), path.size());
        const std::string_view head = path.substr(0, end);
        const std::string_view rest = path.substr(std::min(end + 1, path.size()));
        if (head == "*" && json.is_array())
            for (size_t i = 0; i < json.size(); ++i) descend(json[i], at.at(i), rest, expected);
        if (!json.is_object()) return;
        if (head == "*")
            for (const auto& [key, value] : json.items()) descend(value, at.at(key), rest, expected);
        else if (const auto found = json.find(head); found != json.end())
            descend(*found, at.at(head), rest, expected);
    }

    void inspectMembers(const Json& json, const Thing& owner, const Expected& expected) const {
        if (!json.is_object()) return;
        for (const std::string_view name : expected.names)
            if (name == "*")
                for (const auto& [key, value] : json.items()) inspect(value, owner.at(key), expected.kind);
            else if (const auto found = json.find(name); found != json.end())
                inspect(*found, owner.at(name), expected.kind);
    }

    void inspect(const Json& json, Thing at, Kind kind) const {
        if (isOf(json, kind)) return;
        at.name = at.pointer;
        const auto other =
            std::ranges::find_if(json, [](const Json& element) { return !element.is_number(); });
        if (kind == Kind::Numbers && json.is_array())
            source_.warn(at, "TYPE_MISMATCH", "element {} is no number", other - json.begin());
        else
            source_.warn(at, "TYPE_MISMATCH", "{} is no {} and is ignored", written(json), nameOf(kind));
    }

    static bool isOf(const Json& json, Kind kind) {
        switch (kind) {
        case Kind::Number:
            return json.is_number();
        case Kind::Index:
            return !json.is_structured();
        case Kind::Array:
            return json.is_array();
        case Kind::Boolean:
            return json.is_boolean();
        case Kind::Text:
            return json.is_string();
        case Kind::Object:
            return json.is_object();
        default:
            return json.is_array() &&
                   std::ranges::all_of(json, [](const Json& element) { return element.is_number(); });
        }
    }

    static std::string written(const Json& json) {
        constexpr size_t kMost = 40;
        if (json.is_object()) return "an object";
        if (json.is_array()) return "an array";
        const std::string text = json.dump(-1, ' ', true); // in ASCII, which can be cut anywhere
        return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
    }

    const SourceFile& source_;
    Json json_;
};

} // namespace

void inspectTypes(const SourceFile& source) {
    TypeInspection(source).inspectAll();
}

} // namespace irradia::gltf
