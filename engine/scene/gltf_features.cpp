#include "engine/scene/gltf_features.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace irradia::gltf {
namespace {

constexpr std::array<std::string_view, 5> kReadExtensions{
    "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_specular",
    "KHR_materials_pbrSpecularGlossiness", "KHR_mesh_quantization"};

constexpr size_t kMaxWarnings = 64; // a broken file may earn one for each of a million things

struct IgnoredExtension {
    std::string_view name;
    std::string_view consequence;
};
constexpr std::array<IgnoredExtension, 4> kIgnoredExtensions{{
    {"KHR_materials_transmission", "such materials are opaque"},
    {"KHR_materials_unlit", "such materials are lit"},
    {"KHR_texture_transform", "textures keep their plain coordinates"},
    {"KHR_lights_punctual", "point, spot and directional lights are dark"},
}};

bool isRead(std::string_view name) {
    return std::find(kReadExtensions.begin(), kReadExtensions.end(), name) != kReadExtensions.end();
}

const IgnoredExtension* findIgnored(std::string_view name) {
    const auto found =
        std::find_if(kIgnoredExtensions.begin(), kIgnoredExtensions.end(),
                     [&](const IgnoredExtension& extension) { return extension.name == name; });
    return found == kIgnoredExtensions.end() ? nullptr : &*found;
}

void noteExtensions(const tinygltf::Model& model, SceneNotes& notes) {
    std::string others;
    for (const std::string& name : model.extensionsUsed) {
        if (isRead(name)) continue;
        if (const IgnoredExtension* ignored = findIgnored(name))
            warnOnce(notes, fmt::format("{} is not supported yet: {}", name, ignored->consequence));
        else
            others += (others.empty() ? "" : ", ") + name;
    }
    if (!others.empty()) warnOnce(notes, "optional extensions ignored: " + others);
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

} // namespace

void refuseUnknownExtensions(const SourceFile& source, const std::vector<std::string>& required) {
    for (const std::string& name : required)
        if (!isRead(name) && !findIgnored(name))
            source.refuse("the file requires the extension '{}', which is not supported", name);
}

void noteIgnoredFeatures(const tinygltf::Model& model, SceneNotes& notes) {
    noteExtensions(model, notes);
    noteMaterials(model, notes);
    noteMeshes(model, notes);
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
