#include "engine/scene/gltf/glb.h"
#include "engine/scene/gltf/inspect.h"
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

namespace irradia::gltf {
namespace {

using Json = nlohmann::json;

// tinygltf drops channels without a node, which are valid, so places are told by the JSON.
class AnimationInspection {
public:
    AnimationInspection(const SourceFile& source, const tinygltf::Model& model)
        : source_(source)
        , model_(model)
        , json_(Json::parse(jsonText(source))) {}

    void inspectAll() const {
        const Json animations = elements(json_, "animations");
        for (size_t i = 0; i < animations.size(); ++i) {
            const Json name = member(animations[i], "name");
            const Thing owner =
                thing("animation", "animations", i, name.is_string() ? name.get<std::string>() : "");
            const Json samplers = elements(animations[i], "samplers"),
                       channels = elements(animations[i], "channels");
            for (size_t s = 0; s < samplers.size(); ++s)
                for (const char* key : {"input", "output"})
                    inspectIndex(owner.at("samplers").at(s), samplers[s], key, "accessor",
                                 model_.accessors.size());
            for (size_t c = 0; c < channels.size(); ++c) {
                const Thing channel = owner.at("channels").at(c);
                inspectIndex(channel, channels[c], "sampler", "sampler", samplers.size());
                inspectTarget(channel.at("target"), member(channels[c], "target"));
            }
        }
    }

private:
    // Of what is an object and an array; else none.
    static Json elements(const Json& json, const char* key) {
        Json array = member(json, key);
        return array.is_array() ? array : Json::array();
    }

    // Null where there is none, as of what is no object.
    static Json member(const Json& json, const char* key) {
        return json.is_object() ? json.value(key, Json()) : Json();
    }

    // The index of that name, where there is one and it names what is there.
    std::optional<size_t> inspectIndex(const Thing& owner, const Json& json, const char* key,
                                       std::string_view kind, size_t count) const {
        const Json index = member(json, key);
        if (!index.is_number_unsigned()) return std::nullopt; // others the guard refuses
        if (index.get<uint64_t>() < count) return index.get<size_t>();
        source_.warn(owner.at(key), "UNRESOLVED_REFERENCE", "{} {} of {}", kind, index.get<uint64_t>(),
                     count);
        return std::nullopt;
    }

    void inspectTarget(const Thing& owner, const Json& target) const {
        const Json pathJson = member(target, "path");
        const std::string path = pathJson.is_string() ? pathJson.get<std::string>() : "";
        const auto index = inspectIndex(owner, target, "node", "node", model_.nodes.size());
        const bool isPointer = path == "pointer"; // KHR_animation_pointer
        constexpr std::string_view kPaths[] = {"translation", "rotation", "scale", "weights"};
        if (!isPointer && std::ranges::find(kPaths, path) == std::end(kPaths))
            return source_.warn(owner.at("path"), "VALUE_NOT_IN_LIST", "path '{}'", path);
        if (!index || isPointer) return;
        const tinygltf::Node& node = model_.nodes[*index];
        const Thing at = owner.at("node");
        if (path != "weights" && !node.matrix.empty())
            source_.warn(at, "ANIMATION_CHANNEL_TARGET_NODE_MATRIX", "{} of node {}, which has a matrix",
                         path, *index);
        if (path == "weights" && !hasMorphTargets(node))
            source_.warn(at, "ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS",
                         "node {} has no morph targets", *index);
        if (path != "weights" && node.skin >= 0)
            source_.warn(at, "ANIMATION_CHANNEL_TARGET_NODE_SKIN",
                         "{} of node {}, whose mesh its skin places", path, *index);
    }

    bool hasMorphTargets(const tinygltf::Node& node) const {
        if (node.mesh < 0 || static_cast<size_t>(node.mesh) >= model_.meshes.size()) return false;
        return std::ranges::any_of(
            model_.meshes[node.mesh].primitives,
            [](const tinygltf::Primitive& primitive) { return !primitive.targets.empty(); });
    }

    const SourceFile& source_;
    const tinygltf::Model& model_;
    Json json_;
};

} // namespace

void inspectAnimations(const SourceFile& source, const tinygltf::Model& model) {
    AnimationInspection(source, model).inspectAll();
}

} // namespace irradia::gltf
