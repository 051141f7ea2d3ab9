#include "engine/scene/gltf/features.h"

#include <algorithm>
#include <fmt/ranges.h>
#include <string_view>
#include <vector>

namespace irradia::gltf {
namespace {

constexpr std::string_view kUnsupported = "UNSUPPORTED_EXTENSION";

constexpr std::string_view kReadExtensions[] = {"KHR_materials_emissive_strength",
                                                "KHR_materials_ior",
                                                "KHR_materials_specular",
                                                "KHR_materials_pbrSpecularGlossiness",
                                                "KHR_materials_transmission",
                                                "KHR_materials_volume",
                                                "KHR_materials_unlit",
                                                "KHR_texture_transform",
                                                "KHR_lights_punctual",
                                                "KHR_mesh_quantization",
                                                "EXT_mesh_gpu_instancing",
                                                "EXT_texture_webp",
                                                "EXT_meshopt_compression",
                                                "KHR_draco_mesh_compression",
                                                "KHR_xmp",
                                                "KHR_xmp_json_ld"};

// What changes the picture and is left out: the file can be read all the same.
struct IgnoredExtension {
    std::string_view name;
    std::string_view consequence;
};
constexpr IgnoredExtension kIgnoredExtensions[] = {
    {"KHR_materials_diffuse_transmission", "no light passes through such materials diffusely"},
    {"KHR_materials_dispersion", "such materials refract all colours alike"},
    {"KHR_materials_clearcoat", "such materials have no coat"},
    {"KHR_materials_sheen", "such materials have no sheen"},
    {"KHR_materials_anisotropy", "such materials reflect alike in all directions"},
    {"KHR_materials_iridescence", "such materials have no thin film"},
    {"KHR_materials_variants", "the default variant is shown"},
    {"EXT_lights_image_based", "its light from outside is dark"},
    {"EXT_lights_ies", "such lights shine alike in all directions"},
    {"KHR_node_visibility", "hidden nodes are shown"},
    {"KHR_animation_pointer", "the scene is at rest"},
};

bool isRead(std::string_view name) {
    return std::ranges::find(kReadExtensions, name) != std::end(kReadExtensions);
}

const IgnoredExtension* findIgnored(std::string_view name) {
    const auto* found = std::ranges::find(kIgnoredExtensions, name, &IgnoredExtension::name);
    return found == std::end(kIgnoredExtensions) ? nullptr : found;
}

std::string joined(const std::vector<std::string>& names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

// Valid glTF that the renderer leaves out.
void noteLeftOut(const SourceFile& source, std::string_view pointer, const std::string& sentence) {
    source.note(Severity::Info, pointer, kNotRendered, sentence);
}

void noteSamplers(const SourceFile& source, const tinygltf::Model& model) {
    for (const tinygltf::Sampler& sampler : model.samplers)
        if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST)
            noteLeftOut(source, "/samplers",
                        "nearest filtering is not supported: textures are filtered bilinearly");
}

void noteMeshes(const SourceFile& source, const tinygltf::Model& model) {
    bool targets = false;
    for (const tinygltf::Mesh& mesh : model.meshes)
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            targets = targets || !primitive.targets.empty();
    if (targets)
        noteLeftOut(source, "/meshes",
                    "morph targets stand at rest, at the weights of their meshes and nodes");
}

void warnOfEmptyAccessors(const SourceFile& source, const tinygltf::Model& model) {
    for (size_t i = 0; i < model.accessors.size(); ++i)
        if (model.accessors[i].count == 0)
            source.warn(thing("accessor", "accessors", i, model.accessors[i].name).at("count"),
                        "VALUE_NOT_IN_RANGE", "count 0: what uses it is left out");
}

} // namespace

void refuseUnreadableExtensions(const SourceFile& source, const JsonFindings& findings) {
    for (const std::string& name : findings.extensionsRequired)
        if (!isRead(name) && !findIgnored(name))
            source.attempt({{}, "/extensionsRequired"}, kUnsupported, [&, &name = name] {
                source.refuse("the file requires the extension '{}', which is not supported", name);
            });
}

std::vector<ExtensionUse> extensionsOf(const JsonFindings& findings) {
    std::set<std::string> names = findings.extensionsDeclared;
    names.insert(findings.extensionsRequired.begin(), findings.extensionsRequired.end());
    names.insert(findings.extensionsFound.begin(), findings.extensionsFound.end());
    std::vector<ExtensionUse> uses;
    for (const std::string& name : names) {
        ExtensionUse& use = uses.emplace_back();
        use.name = name;
        use.isDeclared = findings.extensionsDeclared.contains(name);
        use.isRequired = findings.extensionsRequired.contains(name);
        const IgnoredExtension* ignored = findIgnored(name);
        use.support = isRead(name) ? Support::Read : ignored ? Support::Ignored : Support::Unknown;
        if (ignored) use.consequence = ignored->consequence;
    }
    return uses;
}

void noteExtensions(const SourceFile& source, const JsonFindings& findings) {
    std::vector<std::string> undeclared, others;
    for (const ExtensionUse& use : extensionsOf(findings)) {
        if (!use.isDeclared) undeclared.push_back(use.name);
        if (use.support == Support::Unknown && !use.isRequired) others.push_back(use.name);
        if (use.support != Support::Ignored) continue;
        if (use.isRequired)
            source.note(Severity::Warning, "/extensionsRequired", kUnsupported,
                        fmt::format("the file requires {}, which is not rendered yet: {}", use.name,
                                    use.consequence));
        else
            source.note(Severity::Info, "/extensionsUsed", kUnsupported,
                        fmt::format("{} is not supported yet: {}", use.name, use.consequence));
    }
    if (!others.empty())
        source.note(Severity::Info, "/extensionsUsed", kUnsupported,
                    "optional extensions ignored: " + joined(others));
    if (!undeclared.empty())
        source.note(Severity::Warning, "/extensionsUsed", "UNDECLARED_EXTENSION",
                    "extensions used but not declared in extensionsUsed: " + joined(undeclared));
}

void noteIgnoredFeatures(const SourceFile& source, const tinygltf::Model& model) {
    noteSamplers(source, model);
    noteMeshes(source, model);
    warnOfEmptyAccessors(source, model);
    if (!model.skins.empty())
        noteLeftOut(source, "/skins", "skins stand at rest, at the transforms of their joints");
    if (!model.animations.empty())
        noteLeftOut(source, "/animations", "animations are not played: the scene stands at rest");
}

} // namespace irradia::gltf
