#include "engine/scene/gltf/explain.h"

#include "engine/scene/gltf/glb.h"
#include "engine/scene/gltf/json_guard.h"
#include <algorithm>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace irradia::gltf {
namespace {

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

struct Listed {
    const char* array;
    const char* property;
    std::vector<Json> values;
};
const Listed kListed[] = {{"accessors", "componentType", {5120, 5121, 5122, 5123, 5125, 5126}},
                          {"accessors", "type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}},
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

    void checkArray(const Required& required) const {
        const auto found = json_.find(required.array);
        if (found == json_.end() || !isArray(*found, Thing{}.at(required.array))) return;
        for (size_t i = 0; i < found->size(); ++i) {
            const Json& element = (*found)[i];
            const Thing owner = thing(required.kind, required.array, i);
            if (!isObject(element, owner)) continue;
            for (const char* property : required.properties) require(element, owner, property);
            for (const Listed& listed : kListed)
                if (listed.array == std::string_view(required.array)) checkValue(listed, element, owner);
            if (required.array == std::string_view("meshes")) checkPrimitives(element, owner);
        }
    }

    void checkValue(const Listed& listed, const Json& element, const Thing& owner) const {
        const auto found = element.find(listed.property);
        if (found == element.end() || std::ranges::find(listed.values, *found) != listed.values.end()) return;
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
            if (isObject((*found)[p], primitive)) require((*found)[p], primitive, "attributes");
        }
    }

    const SourceFile& source_;
    Json json_;
};

} // namespace

void reportSchemaFaults(const SourceFile& source) {
    SchemaCheck(source).checkAll();
}

} // namespace irradia::gltf
