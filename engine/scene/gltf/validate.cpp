#include "engine/scene/gltf/validate.h"

#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/model_check.h"
#include "engine/scene/gltf/primitives.h"
#include <cmath>

namespace irradia::gltf {
namespace {

class ThingCheck : private ModelCheck {
public:
    using ModelCheck::ModelCheck;

    void checkAll(Soundness& sound) const {
        const auto all = [](size_t count, const auto& isGood) {
            bool areGood = true;
            for (size_t i = 0; i < count; ++i) areGood = isGood(i) && areGood;
            return areGood;
        };
        const auto each = [&](const auto& things, void (ThingCheck::*check)(size_t) const) {
            return all(things.size(), [&](size_t i) { return attempt([&] { (this->*check)(i); }); });
        };
        sound.materials = each(model_.images, &ThingCheck::checkImage);
        sound.materials = each(model_.textures, &ThingCheck::checkTexture) && sound.materials;
        sound.materials = each(model_.samplers, &ThingCheck::checkSampler) && sound.materials;
        sound.materials = each(model_.materials, &ThingCheck::checkMaterial) && sound.materials;
        sound.meshes = all(model_.meshes.size(), [&](size_t i) { return checkMesh(i); });
        sound.cameras = each(model_.cameras, &ThingCheck::checkCamera);
        each(model_.skins, &ThingCheck::checkSkin); // which are not read
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
        const auto& pbr = material.pbrMetallicRoughness;
        const Thing pbrThing = owner.at("pbrMetallicRoughness");
        const auto checkTextureIndex = [&](const Thing& parent, std::string_view name, int texture) {
            checkIndex(parent.at(name).at("index"), "texture", texture, model_.textures.size(),
                       Need::Optional);
        };
        checkTextureIndex(pbrThing, "baseColorTexture", pbr.baseColorTexture.index);
        checkTextureIndex(pbrThing, "metallicRoughnessTexture", pbr.metallicRoughnessTexture.index);
        checkTextureIndex(owner, "normalTexture", material.normalTexture.index);
        checkTextureIndex(owner, "occlusionTexture", material.occlusionTexture.index);
        checkTextureIndex(owner, "emissiveTexture", material.emissiveTexture.index);
        for (const auto& [name, extension] : material.extensions) {
            for (const std::string& key : extension.Keys()) {
                const tinygltf::Value& texture = extension.Get(key);
                if (texture.IsObject() && texture.Has("index"))
                    checkIndex(owner.called(name).at("extensions").at(name).at(key).at("index"), "texture",
                               texture.Get("index").GetNumberAsInt(), model_.textures.size(), Need::Required);
            }
        }
    }

    bool checkMesh(size_t index) const {
        const tinygltf::Mesh& mesh = model_.meshes[index];
        bool isGood = true;
        for (size_t p = 0; p < mesh.primitives.size(); ++p) {
            const tinygltf::Primitive& primitive = mesh.primitives[p];
            const Thing owner = primitiveThing(index, mesh, p);
            isGood = attempt([&] { checkPrimitive(owner, primitive); }) && isGood;
            for (const auto& [name, accessor] : primitive.attributes)
                isGood =
                    attempt([&] { checkAttribute(owner.at("attributes"), primitive, name, accessor); }) &&
                    isGood;
            for (size_t t = 0; t < primitive.targets.size(); ++t)
                for (const auto& [name, accessor] : primitive.targets[t])
                    isGood = attempt([&] {
                                 checkAttribute(owner.at("targets").at(t), primitive, name, accessor);
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
    }

    void checkIndices(const Thing& owner, const tinygltf::Primitive& primitive) const {
        checkIndex(owner, "accessor", primitive.indices, model_.accessors.size(), Need::Optional);
        if (primitive.indices == -1) return;
        const tinygltf::Accessor& accessor = model_.accessors[primitive.indices];
        if (accessor.type != TINYGLTF_TYPE_SCALAR || !isIndexType(accessor.componentType) ||
            accessor.normalized)
            source_.refuse(owner, "MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT", "accessor {}",
                           primitive.indices);
    }

    void checkAttribute(const Thing& owner, const tinygltf::Primitive& primitive, const std::string& name,
                        int index) const {
        const Thing what = owner.called(name).at(name);
        checkIndex(what, "accessor", index, model_.accessors.size(), Need::Required);
        const tinygltf::Accessor& accessor = model_.accessors[index];
        const bool vec2 = name.starts_with("TEXCOORD_");
        const bool vec3 = name == "POSITION" || name == "NORMAL";
        if ((vec2 && accessor.type != TINYGLTF_TYPE_VEC2) || (vec3 && accessor.type != TINYGLTF_TYPE_VEC3))
            source_.refuse(what, "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", "accessor {}", index);
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) return;
        checkIndex(owner.called("POSITION").at("POSITION"), "accessor", position->second,
                   model_.accessors.size(), Need::Required);
        const uint64_t vertices = model_.accessors[position->second].count;
        if (accessor.count != vertices)
            source_.refuse(what, "MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", "{} for {} positions",
                           accessor.count, vertices);
    }

    void checkCamera(size_t index) const {
        const tinygltf::Camera& camera = model_.cameras[index];
        const Thing owner = thing("camera", "cameras", index, camera.name);
        const double fov = camera.perspective.yfov; // radians
        const double height = std::abs(camera.orthographic.ymag);
        if (camera.type == "orthographic" && !(height > 1e-30 && height < 1e30))
            source_.refuse(owner.at("orthographic").at("ymag"), "VALUE_NOT_IN_RANGE", "ymag {}",
                           camera.orthographic.ymag);
        if (camera.type == "perspective" && !(fov > 1e-6 && fov < 3.14159265))
            source_.refuse(owner.at("perspective").at("yfov"), "VALUE_NOT_IN_RANGE", "yfov {}", fov);
    }

    void checkSkin(size_t index) const {
        const tinygltf::Skin& skin = model_.skins[index];
        const Thing owner = thing("skin", "skins", index, skin.name);
        checkIndex(owner.at("inverseBindMatrices"), "accessor", skin.inverseBindMatrices,
                   model_.accessors.size(), Need::Optional);
        checkIndex(owner.at("skeleton"), "node", skin.skeleton, model_.nodes.size(), Need::Optional);
        for (const int joint : skin.joints)
            checkIndex(owner.at("joints"), "node", joint, model_.nodes.size(), Need::Required);
    }
};

} // namespace

Soundness validateModel(const SourceFile& source, const tinygltf::Model& model) {
    Soundness sound;
    sound.data = checkData(source, model);
    ThingCheck(source, model).checkAll(sound);
    sound.nodes = checkNodes(source, model);
    return sound;
}

} // namespace irradia::gltf
