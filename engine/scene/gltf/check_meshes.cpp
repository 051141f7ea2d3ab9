#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/model_check.h"
#include "engine/scene/gltf/primitives.h"
#include <algorithm>
#include <fmt/ranges.h>
#include <span>

namespace irradia::gltf {
namespace {

// What an attribute may be stored as. Of components f = float, b, u = signed and unsigned byte, s, w = signed
// and unsigned short; capital where normalised.
struct Format {
    std::string_view name; // or how it begins, up to the number of the set
    std::vector<int> types;
    std::string_view components;
    std::string_view quantised; // those of KHR_mesh_quantization
};

// glTF 2.0, 3.7.2.1, and KHR_mesh_quantization.
const Format kAttributes[] = {{"POSITION", {TINYGLTF_TYPE_VEC3}, "fbBuUsSwW", "bBuUsSwW"},
                              {"NORMAL", {TINYGLTF_TYPE_VEC3}, "fBS", "BS"},
                              {"TANGENT", {TINYGLTF_TYPE_VEC4}, "fBS", "BS"},
                              {"TEXCOORD_", {TINYGLTF_TYPE_VEC2}, "fbBuUsSwW", "bBusSw"},
                              {"COLOR_", {TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4}, "fUW", ""},
                              {"JOINTS_", {TINYGLTF_TYPE_VEC4}, "uw", ""},
                              {"WEIGHTS_", {TINYGLTF_TYPE_VEC4}, "fUW", ""}};

// glTF 2.0, 3.7.2.2: what they add to these.
const Format kTargets[] = {{"POSITION", {TINYGLTF_TYPE_VEC3}, "fbBuUsSwW", "bBuUsSwW"},
                           {"NORMAL", {TINYGLTF_TYPE_VEC3}, "fBS", "BS"},
                           {"TANGENT", {TINYGLTF_TYPE_VEC3}, "fBS", "BS"},
                           {"TEXCOORD_", {TINYGLTF_TYPE_VEC2}, "fbBuUsSwW", "busw"},
                           {"COLOR_", {TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4}, "fBUSW", ""}};

// Null for attributes of the file's own, which nobody reads.
const Format* formatOf(std::string_view name, std::span<const Format> formats) {
    const auto found = std::ranges::find_if(formats, [&](const Format& format) {
        return format.name.ends_with('_') ? name.starts_with(format.name) : name == format.name;
    });
    return found == formats.end() ? nullptr : &*found;
}

constexpr char kNoLetter = '?';

struct Component {
    char letter;
    std::string_view name;
};
constexpr Component kComponents[] = {{'f', "floats"},
                                     {'F', "normalised floats"},
                                     {'b', "bytes"},
                                     {'B', "normalised bytes"},
                                     {'u', "unsigned bytes"},
                                     {'U', "normalised unsigned bytes"},
                                     {'s', "shorts"},
                                     {'S', "normalised shorts"},
                                     {'w', "unsigned shorts"},
                                     {'W', "normalised unsigned shorts"},
                                     {'i', "unsigned integers"},
                                     {'I', "normalised unsigned integers"}};

char componentLetter(const tinygltf::Accessor& accessor) {
    constexpr std::string_view kPlain = "buswif", kNormalised = "BUSWIF";
    constexpr int kOrder[] = {TINYGLTF_COMPONENT_TYPE_BYTE,         TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                              TINYGLTF_COMPONENT_TYPE_SHORT,        TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                              TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_COMPONENT_TYPE_FLOAT};
    const auto* found = std::ranges::find(kOrder, accessor.componentType);
    if (found == std::end(kOrder)) return kNoLetter;
    return (accessor.normalized ? kNormalised : kPlain)[static_cast<size_t>(found - kOrder)];
}

// Of types and components, as "VEC3 or VEC4 of floats, unsigned bytes".
std::string wordsOf(std::span<const int> types, std::string_view components) {
    const auto nameOfType = [](int type) -> std::string_view {
        switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return "SCALAR";
        case TINYGLTF_TYPE_VEC2:
            return "VEC2";
        case TINYGLTF_TYPE_VEC3:
            return "VEC3";
        case TINYGLTF_TYPE_VEC4:
            return "VEC4";
        default:
            return "matrices";
        }
    };
    const auto nameOfComponent = [](char letter) -> std::string_view {
        const auto* const found = std::ranges::find(kComponents, letter, &Component::letter);
        return found == std::end(kComponents) ? "unknown" : found->name;
    };
    std::vector<std::string_view> typeNames, componentNames;
    for (const int type : types) typeNames.push_back(nameOfType(type));
    for (const char letter : components) componentNames.push_back(nameOfComponent(letter));
    return fmt::format("{} of {}", fmt::join(typeNames, " or "), fmt::join(componentNames, ", "));
}

std::string wordsOf(const tinygltf::Accessor& accessor) {
    const char letter = componentLetter(accessor);
    return wordsOf(std::span(&accessor.type, 1), {&letter, 1});
}

bool isAllowed(const Format* format, const tinygltf::Accessor& accessor) {
    const char component = componentLetter(accessor);
    if (!format || component == kNoLetter) return true; // an unknown component is the accessor's own fault
    return std::ranges::find(format->types, accessor.type) != format->types.end() &&
           format->components.find(component) != std::string_view::npos;
}

class MeshCheck : private ModelCheck {
public:
    using ModelCheck::ModelCheck;

    bool checkAll() const {
        bool areGood = true;
        for (size_t i = 0; i < model_.meshes.size(); ++i) areGood = checkMesh(i) && areGood;
        return areGood;
    }

private:
    bool checkMesh(size_t index) const {
        const tinygltf::Mesh& mesh = model_.meshes[index];
        bool isGood = attempt([&] { checkTargets(thing("mesh", "meshes", index, mesh.name), mesh); });
        for (size_t p = 0; p < mesh.primitives.size(); ++p) {
            const tinygltf::Primitive& primitive = mesh.primitives[p];
            const Thing owner = primitiveThing(index, mesh, p);
            isGood = attempt([&] { checkPrimitive(owner, primitive); }) && isGood;
            for (const auto& [name, accessor] : primitive.attributes)
                isGood = attempt([&] {
                             checkAttribute(owner.at("attributes"), primitive, name, accessor,
                                            formatOf(name, kAttributes));
                         }) &&
                         isGood;
            for (size_t t = 0; t < primitive.targets.size(); ++t)
                for (const auto& [name, accessor] : primitive.targets[t])
                    isGood = attempt([&] {
                                 checkAttribute(owner.at("targets").at(t), primitive, name, accessor,
                                                formatOf(name, kTargets));
                             }) &&
                             isGood;
        }
        return isGood;
    }

    void checkPrimitive(const Thing& owner, const tinygltf::Primitive& primitive) const {
        checkIndex(owner.at("material"), "material", primitive.material, model_.materials.size(),
                   Need::Optional);
        if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
            source_.refuse(owner.at("mode"), "VALUE_NOT_IN_LIST", "mode {}", primitive.mode);
        checkIndices(owner.at("indices"), primitive);
        for (int set = 0; primitive.attributes.contains(fmt::format("JOINTS_{}", set)); ++set)
            if (!primitive.attributes.contains(fmt::format("WEIGHTS_{}", set)))
                source_.refuse(owner.at("attributes"), "MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH",
                               "JOINTS_{0} without WEIGHTS_{0}", set);
    }

    // Targets are told apart by their number alone, so all primitives have as many.
    void checkTargets(const Thing& owner, const tinygltf::Mesh& mesh) const {
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            if (primitive.targets.size() != mesh.primitives.front().targets.size())
                source_.refuse(owner.at("primitives"), "MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT",
                               "{} and {} morph targets", mesh.primitives.front().targets.size(),
                               primitive.targets.size());
            if (!mesh.weights.empty() && mesh.weights.size() != primitive.targets.size())
                source_.refuse(owner.at("weights"), "MESH_INVALID_WEIGHTS_COUNT",
                               "{} weights for {} morph targets", mesh.weights.size(),
                               primitive.targets.size());
        }
    }

    void checkIndices(const Thing& owner, const tinygltf::Primitive& primitive) const {
        checkIndex(owner, "accessor", primitive.indices, model_.accessors.size(), Need::Optional);
        if (primitive.indices == -1) return;
        const tinygltf::Accessor& accessor = model_.accessors[primitive.indices];
        constexpr int kScalar[] = {TINYGLTF_TYPE_SCALAR};
        if (accessor.type != TINYGLTF_TYPE_SCALAR || !isIndexType(accessor.componentType) ||
            accessor.normalized)
            source_.refuse(owner, "MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT",
                           "accessor {} holds {}, allowed are {}", primitive.indices, wordsOf(accessor),
                           wordsOf(kScalar, "uwi"));
    }

    void checkAttribute(const Thing& owner, const tinygltf::Primitive& primitive, const std::string& name,
                        int index, const Format* format) const {
        const Thing what = owner.called(name).at(name);
        checkIndex(what, "accessor", index, model_.accessors.size(), Need::Required);
        const tinygltf::Accessor& accessor = model_.accessors[index];
        if (!isAllowed(format, accessor))
            source_.refuse(what, "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
                           "accessor {} holds {}, allowed are {}", index, wordsOf(accessor),
                           wordsOf(format->types, format->components));
        warnOfQuantisation(what, accessor, format);
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) return;
        checkIndex(owner.called("POSITION").at("POSITION"), "accessor", position->second,
                   model_.accessors.size(), Need::Required);
        const uint64_t vertices = model_.accessors[position->second].count;
        if (accessor.count != vertices)
            source_.refuse(what, "MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", "{} for {} positions",
                           accessor.count, vertices);
    }

    // Readers without the extension refuse such accessors.
    void warnOfQuantisation(const Thing& what, const tinygltf::Accessor& accessor,
                            const Format* format) const {
        constexpr const char* kName = "KHR_mesh_quantization";
        if (!format || std::ranges::find(model_.extensionsUsed, kName) != model_.extensionsUsed.end()) return;
        if (format->quantised.find(componentLetter(accessor)) != std::string_view::npos)
            source_.warn(what, "UNDECLARED_EXTENSION", "{} need {}, which extensionsUsed does not declare",
                         wordsOf(accessor), kName);
    }
};

} // namespace

bool checkMeshes(const SourceFile& source, const tinygltf::Model& model) {
    return MeshCheck(source, model).checkAll();
}

} // namespace irradia::gltf
