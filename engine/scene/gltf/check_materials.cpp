#include "engine/scene/gltf/model_check.h"
#include "engine/scene/gltf/values.h"
#include <algorithm>

namespace irradia::gltf {
namespace {

class MaterialCheck : private ModelCheck {
public:
    using ModelCheck::ModelCheck;

    bool checkAll() const {
        bool isGood = each(model_.images, [&](size_t i) { checkImage(i); });
        isGood = each(model_.textures, [&](size_t i) { checkTexture(i); }) && isGood;
        isGood = each(model_.samplers, [&](size_t i) { checkSampler(i); }) && isGood;
        return each(model_.materials, [&](size_t i) { checkMaterial(i); }) && isGood;
    }

private:
    void checkImage(size_t index) const {
        const tinygltf::Image& image = model_.images[index];
        checkIndex(thing("image", "images", index, image.name).at("bufferView"), "buffer view",
                   image.bufferView, model_.bufferViews.size(), Need::Optional);
    }

    void checkTexture(size_t index) const {
        const tinygltf::Texture& texture = model_.textures[index];
        const Thing owner = thing("texture", "textures", index, texture.name);
        checkIndex(owner.at("source"), "image", texture.source, model_.images.size(), Need::Optional);
        if (const Extension webp = findExtension(texture.extensions, "EXT_texture_webp"))
            checkIndex(owner.at("extensions").at("EXT_texture_webp").at("source"), "image",
                       static_cast<int>(plainNumber(*webp, "source", -1)), model_.images.size(),
                       Need::Optional);
        checkIndex(owner.at("sampler"), "sampler", texture.sampler, model_.samplers.size(), Need::Optional);
    }

    void checkSampler(size_t index) const {
        const tinygltf::Sampler& sampler = model_.samplers[index];
        for (const int wrap : {sampler.wrapS, sampler.wrapT})
            if (wrap != TINYGLTF_TEXTURE_WRAP_REPEAT && wrap != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE &&
                wrap != TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT)
                source_.refuse(thing("sampler", "samplers", index, sampler.name), "VALUE_NOT_IN_LIST",
                               "wrap mode {}", wrap);
    }

    void checkMaterial(size_t index) const {
        const tinygltf::Material& material = model_.materials[index];
        const Thing owner = thing("material", "materials", index, material.name);
        if (material.alphaMode != "OPAQUE" && material.alphaMode != "MASK" && material.alphaMode != "BLEND")
            source_.refuse(owner.at("alphaMode"), "VALUE_NOT_IN_LIST", "alphaMode '{}', there are {}",
                           material.alphaMode, "OPAQUE, MASK, BLEND");

        const auto& pbr = material.pbrMetallicRoughness;
        const Thing pbrThing = owner.at("pbrMetallicRoughness");
        checkInfo(pbrThing.at("baseColorTexture"), pbr.baseColorTexture);
        checkInfo(pbrThing.at("metallicRoughnessTexture"), pbr.metallicRoughnessTexture);
        checkInfo(owner.at("normalTexture"), material.normalTexture);
        checkInfo(owner.at("occlusionTexture"), material.occlusionTexture);
        checkInfo(owner.at("emissiveTexture"), material.emissiveTexture);
        for (const auto& [name, extension] : material.extensions)
            for (const std::string& key : extension.Keys()) {
                const Thing at = owner.called(name).at("extensions").at(name).at(key);
                checkInfo(at, extension.Get(key));
                if (key.ends_with("Factor") || key.ends_with("Color")) // those that are arrays are colours
                    checkArray(at, extension.Get(key), key, {3, 4});
            }
    }

    // Of tinygltf's own sorts of infos.
    template <typename Info>
    void checkInfo(const Thing& at, const Info& info) const {
        checkIndex(at.at("index"), "texture", info.index, model_.textures.size(), Need::Optional);
        if (const Extension transform = findExtension(info.extensions, kTransform))
            checkTransform(at, *transform);
    }

    // Of an extension: a value that may be something else.
    void checkInfo(const Thing& at, const tinygltf::Value& info) const {
        if (!info.Has("index")) return;
        checkIndex(at.at("index"), "texture", info.Get("index").GetNumberAsInt(), model_.textures.size(),
                   Need::Required);
        checkTransform(at, member(member(info, "extensions"), kTransform));
    }

    void checkTransform(const Thing& info, const tinygltf::Value& transform) const {
        const Thing at = info.at("extensions").at(kTransform);
        for (const char* key : {"offset", "scale"}) checkArray(at.at(key), member(transform, key), key, {2});
    }

    void checkArray(const Thing& at, const tinygltf::Value& value, std::string_view key,
                    std::initializer_list<size_t> lengths) const {
        if (value.IsArray() && std::ranges::find(lengths, value.ArrayLen()) == lengths.end())
            source_.refuse(at, "ARRAY_LENGTH_NOT_IN_LIST", "{} of {} numbers", key, value.ArrayLen());
    }

    static constexpr const char* kTransform = "KHR_texture_transform";
};

} // namespace

bool checkMaterials(const SourceFile& source, const tinygltf::Model& model) {
    return MaterialCheck(source, model).checkAll();
}

} // namespace irradia::gltf
