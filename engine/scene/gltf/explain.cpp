#include "engine/scene/gltf/explain.h"

#include "engine/scene/gltf/glb.h"
#include "engine/scene/gltf/json_guard.h"
#include <algorithm>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace irradia::gltf {
namespace {

using namespace nlohmann::literals;
using Json = nlohmann::json;

// What every element of one of the file's arrays must have (glTF 2.0, 5).
struct Required {
    const char* array;
    const char* kind;
    std::vector<const char*> properties;
};
const Required kRequired[] = {{"buffers", "buffer", {"byteLength"}},
                              {"bufferViews", "buffer view", {"buffer", "byteLength"}},
                              {"accessors", "accessor", {"componentType", "count", "type"}},
                              {"meshes", "mesh", {"primitives"}},
                              {"cameras", "camera", {"type"}},
                              {"skins", "skin", {"joints"}},
                              {"animations", "animation", {"channels", "samplers"}},
                              {"nodes", "node", {}},
                              {"materials", "material", {}},
                              {"textures", "texture", {}},
                              {"images", "image", {}},
                              {"samplers", "sampler", {}},
                              {"scenes", "scene", {}}};

constexpr std::string_view kIntegers[] = {"buffer", "byteLength", "componentType", "count"};

// Texture infos, which must have an index.
const Json::json_pointer kTextureInfos[] = {"/normalTexture"_json_pointer, "/occlusionTexture"_json_pointer,
                                            "/emissiveTexture"_json_pointer,
                                            "/pbrMetallicRoughness/baseColorTexture"_json_pointer,
                                            "/pbrMetallicRoughness/metallicRoughnessTexture"_json_pointer};

// Colours, of so many numbers.
struct Colour {
    Json::json_pointer path;
    size_t length;
};
const Colour kColours[] = {{"/emissiveFactor"_json_pointer, 3},
                           {"/pbrMetallicRoughness/baseColorFactor"_json_pointer, 4}};

// What a camera of either type needs: numbers.
struct Projection {
    const char* type;
    std::vector<const char*> numbers;
};
const Projection kProjections[] = {{"perspective", {"yfov", "znear"}},
                                   {"orthographic", {"xmag", "ymag", "zfar", "znear"}}};

const Json::json_pointer kLightsPath = "/extensions/KHR_lights_punctual/lights"_json_pointer;

struct Listed {
    const char* array;
    const char* property;
    std::vector<Json> values;
};
const Listed kListed[] = {{"accessors", "componentType", {5120, 5121, 5122, 5123, 5125, 5126}},
                          {"accessors", "type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}},
                          {"lights", "type", {"point", "spot", "directional"}},
                          {"cameras", "type", {"perspective", "orthographic"}},
                          {"materials", "alphaMode", {"OPAQUE", "MASK", "BLEND"}}};

class SchemaCheck {
public:
    explicit SchemaCheck(const SourceFile& source)
        : source_(source)
        , json_(Json::parse(jsonText(source))) {}

    void checkAll() const {
        if (!json_.is_object()) return source_.report({}, "TYPE_MISMATCH", "an object is needed");
        require(json_, {}, "asset");
        if (json_.contains("asset") && isObject(json_["asset"], {{}, "/asset"}))
            require(json_["asset"], {{}, "/asset"}, "version");
        for (const Required& required : kRequired) checkArray(required);
        checkLights();
    }

private:
    bool isObject(const Json& json, const Thing& at) const {
        if (!json.is_object()) source_.report(at, "TYPE_MISMATCH", "an object is needed");
        return json.is_object();
    }

    bool isArray(const Json& json, const Thing& at) const {
        if (!json.is_array()) source_.report(at, "TYPE_MISMATCH", "an array is needed");
        return json.is_array();
    }

    void require(const Json& json, const Thing& owner, const char* property) const {
        if (!json.contains(property))
            source_.report(owner.at(property), "UNDEFINED_PROPERTY", "the property '{}' is missing",
                           property);
    }

    // What the guard has left of those that are none: arrays and objects.
    void requireInteger(const Json& json, const Thing& owner, const std::string& property) const {
        if (json.contains(property) && json[property].is_structured())
            source_.report(owner.at(property), "TYPE_MISMATCH", "a non-negative integer is needed");
    }

    void checkArray(const Required& required) const {
        const auto found = json_.find(required.array);
        if (found == json_.end() || !isArray(*found, Thing{}.at(required.array))) return;
        for (size_t i = 0; i < found->size(); ++i) {
            const Json& element = (*found)[i];
            const Thing owner = thing(required.kind, required.array, i);
            if (!isObject(element, owner)) continue;
            for (const char* property : required.properties) {
                require(element, owner, property);
                if (std::ranges::find(kIntegers, property) != std::end(kIntegers))
                    requireInteger(element, owner, property);
            }
            checkValues(required.array, element, owner);
            if (required.array == std::string_view("meshes")) checkPrimitives(element, owner);
            if (required.array == std::string_view("materials")) checkMaterial(element, owner);
            if (required.array == std::string_view("cameras")) checkCamera(element, owner);
        }
    }

    void checkValues(std::string_view array, const Json& element, const Thing& owner) const {
        for (const Listed& listed : kListed)
            if (listed.array == array) checkValue(listed, element, owner);
    }

    void checkValue(const Listed& listed, const Json& element, const Thing& owner) const {
        const auto found = element.find(listed.property);
        if (found == element.end() || std::ranges::find(listed.values, *found) != listed.values.end()) return;
        if (listed.values.front().is_string() && !found->is_string())
            return source_.report(owner.at(listed.property), "TYPE_MISMATCH", "a text is needed");
        std::vector<std::string> known;
        for (const Json& value : listed.values) known.push_back(value.dump());
        constexpr auto kReplace = Json::error_handler_t::replace; // of what is no UTF-8
        source_.report(owner.at(listed.property), "VALUE_NOT_IN_LIST", "{} {}, there are {}", listed.property,
                       found->dump(-1, ' ', false, kReplace), fmt::join(known, ", "));
    }

    void checkPrimitives(const Json& mesh, const Thing& owner) const {
        const auto found = mesh.find("primitives");
        if (found == mesh.end() || !isArray(*found, owner.at("primitives"))) return;
        for (size_t p = 0; p < found->size(); ++p) {
            const Thing primitive = owner.called(fmt::format("primitive {}", p)).at("primitives").at(p);
            if (!isObject((*found)[p], primitive)) continue;
            require((*found)[p], primitive, "attributes");
            const Thing at = primitive.at("attributes");
            if (!(*found)[p].contains("attributes") || !isObject((*found)[p]["attributes"], at)) continue;
            for (const auto& [name, accessor] : (*found)[p]["attributes"].items())
                requireInteger((*found)[p]["attributes"], at, name);
        }
    }

    void checkMaterial(const Json& material, const Thing& owner) const {
        for (const Json::json_pointer& path : kTextureInfos) {
            const Thing at{owner.name, owner.pointer + path.to_string()};
            if (material.contains(path) && isObject(material[path], at)) require(material[path], at, "index");
        }
        for (const Colour& colour : kColours)
            if (material.contains(colour.path) && material[colour.path].is_array() &&
                material[colour.path].size() != colour.length)
                source_.report({owner.name, owner.pointer + colour.path.to_string()},
                               "ARRAY_LENGTH_NOT_IN_LIST", "{} of {} numbers, not {}", colour.path.back(),
                               material[colour.path].size(), colour.length);
    }

    void checkCamera(const Json& camera, const Thing& owner) const {
        for (const Projection& projection : kProjections) {
            if (camera.value("type", Json()) != projection.type) continue;
            require(camera, owner, projection.type);
            const Thing at = owner.at(projection.type);
            if (!camera.contains(projection.type) || !isObject(camera[projection.type], at)) continue;
            const Json& values = camera[projection.type];
            for (const char* number : projection.numbers) {
                require(values, at, number);
                if (values.contains(number) && !values[number].is_number())
                    source_.report(at.at(number), "TYPE_MISMATCH", "a number is needed");
            }
        }
    }

    void checkLights() const {
        if (!json_.contains(kLightsPath)) return;
        const Json& lights = json_[kLightsPath];
        if (!isArray(lights, {{}, kLightsPath.to_string()})) return;
        for (size_t i = 0; i < lights.size(); ++i) {
            Thing owner = thing("light", "lights", i);
            owner.pointer = fmt::format("{}/{}", kLightsPath.to_string(), i);
            if (!isObject(lights[i], owner)) continue;
            require(lights[i], owner, "type");
            checkValues("lights", lights[i], owner);
            if (lights[i].value("type", Json()) != "spot") continue;
            require(lights[i], owner, "spot");
            if (lights[i].contains("spot")) isObject(lights[i]["spot"], owner.at("spot"));
        }
    }

    const SourceFile& source_;
    const Json json_; // whose [] of what is not there would add it
};

} // namespace

void reportSchemaFaults(const SourceFile& source) {
    SchemaCheck(source).checkAll();
}

} // namespace irradia::gltf
