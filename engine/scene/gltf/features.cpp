#include "engine/scene/gltf/features.h"

#include <algorithm>
#include <fmt/ranges.h>
#include <string_view>
#include <vector>

namespace irradia::gltf {
namespace {

// Those that change nothing in a picture are among them.
constexpr std::string_view kReadExtensions[] = {"KHR_materials_emissive_strength",
                                                "KHR_materials_ior",
                                                "KHR_materials_specular",
                                                "KHR_materials_pbrSpecularGlossiness",
                                                "KHR_mesh_quantization",
                                                "KHR_xmp",
                                                "KHR_xmp_json_ld"};

constexpr size_t kMaxWarnings = 64; // a broken file may earn one for each of a million things

// What changes the picture and is left out: the file can be read all the same.
struct IgnoredExtension {
    std::string_view name;
    std::string_view consequence;
};
constexpr IgnoredExtension kIgnoredExtensions[] = {
    {"KHR_materials_transmission", "such materials are opaque"},
    {"KHR_materials_diffuse_transmission", "such materials are opaque"},
    {"KHR_materials_volume", "such materials are opaque"},
    {"KHR_materials_dispersion", "such materials are opaque"},
    {"KHR_materials_unlit", "such materials are lit"},
    {"KHR_materials_clearcoat", "such materials have no coat"},
    {"KHR_materials_sheen", "such materials have no sheen"},
    {"KHR_materials_anisotropy", "such materials reflect alike in all directions"},
    {"KHR_materials_iridescence", "such materials have no thin film"},
    {"KHR_materials_variants", "the default variant is shown"},
    {"KHR_texture_transform", "textures keep their plain coordinates"},
    {"KHR_lights_punctual", "point, spot and directional lights are dark"},
    {"EXT_lights_image_based", "its light from outside is dark"},
    {"EXT_lights_ies", "such lights are dark"},
    {"EXT_mesh_gpu_instancing", "each such mesh stands once"},
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

void noteMaterials(const tinygltf::Model& model, SceneNotes& notes) {
    const auto transparent =
        std::count_if(model.materials.begin(), model.materials.end(),
                      [](const auto& material) { return material.alphaMode != "OPAQUE"; });
    if (transparent > 0)
        warnOnce(notes,
                 fmt::format("alpha modes are not supported yet: {} materials are opaque", transparent));
    for (const tinygltf::Sampler& sampler : model.samplers)
        if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST)
            warnOnce(notes, "nearest filtering is not supported: textures are filtered bilinearly");
}

void noteMeshes(const tinygltf::Model& model, SceneNotes& notes) {
    bool colours = false, targets = false;
    for (const tinygltf::Mesh& mesh : model.meshes)
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            colours = colours || primitive.attributes.contains("COLOR_0");
            targets = targets || !primitive.targets.empty();
        }
    if (colours) warnOnce(notes, "vertex colours are ignored");
    if (targets) warnOnce(notes, "morph targets are not supported yet: meshes keep their base shape");
}

void noteEmptyAccessors(const tinygltf::Model& model, SceneNotes& notes) {
    for (size_t i = 0; i < model.accessors.size(); ++i)
        if (model.accessors[i].count == 0)
            warnOnce(notes, label("accessor", i, model.accessors[i].name) +
                                ": VALUE_NOT_IN_RANGE: count 0: what uses it is left out");
}

} // namespace

void refuseUnreadableExtensions(const SourceFile& source, const JsonFindings& findings) {
    for (const std::string& name : findings.extensionsRequired)
        if (!isRead(name) && !findIgnored(name))
            source.refuse("the file requires the extension '{}', which is not supported", name);
}

void noteExtensions(const JsonFindings& findings, SceneNotes& notes) {
    std::set<std::string> names = findings.extensionsDeclared;
    names.insert(findings.extensionsRequired.begin(), findings.extensionsRequired.end());
    names.insert(findings.extensionsFound.begin(), findings.extensionsFound.end());
    std::vector<std::string> undeclared, others;
    for (const std::string& name : names) {
        if (!findings.extensionsDeclared.contains(name)) undeclared.push_back(name);
        if (isRead(name)) continue;
        const IgnoredExtension* ignored = findIgnored(name);
        if (!ignored)
            others.push_back(name);
        else if (findings.extensionsRequired.contains(name))
            warnOnce(notes, fmt::format("the file requires {}, which is not rendered yet: {}", name,
                                        ignored->consequence));
        else
            warnOnce(notes, fmt::format("{} is not supported yet: {}", name, ignored->consequence));
    }
    if (!others.empty()) warnOnce(notes, "optional extensions ignored: " + joined(others));
    if (!undeclared.empty())
        warnOnce(notes, "extensions used but not declared in extensionsUsed: " + joined(undeclared));
}

void noteIgnoredFeatures(const tinygltf::Model& model, SceneNotes& notes) {
    noteMaterials(model, notes);
    noteMeshes(model, notes);
    noteEmptyAccessors(model, notes);
    if (!model.skins.empty())
        warnOnce(notes, "skins are not supported yet: meshes keep their unskinned shape");
    if (!model.animations.empty()) warnOnce(notes, "animations are not supported yet: the scene is at rest");
}

void warnOnce(SceneNotes& notes, const std::string& text) {
    const std::string warning = printable(text);
    if (std::find(notes.warnings.begin(), notes.warnings.end(), warning) != notes.warnings.end()) return;
    if (notes.warnings.size() < kMaxWarnings)
        notes.warnings.push_back(warning);
    else if (notes.warnings.size() == kMaxWarnings)
        notes.warnings.push_back("there are more warnings");
}

} // namespace irradia::gltf
