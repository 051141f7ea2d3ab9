#include "engine/scene/gltf/validate.h"

#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/model_check.h"
#include <cmath>

namespace irradia::gltf {
namespace {

class ThingCheck : private ModelCheck {
public:
    using ModelCheck::ModelCheck;

    void checkAll() const {
        for (size_t i = 0; i < model_.images.size(); ++i) checkImage(i);
        for (size_t i = 0; i < model_.textures.size(); ++i) checkTexture(i);
        for (size_t i = 0; i < model_.samplers.size(); ++i) checkSampler(i);
        for (size_t i = 0; i < model_.materials.size(); ++i) checkMaterial(i);
        for (size_t i = 0; i < model_.meshes.size(); ++i) checkMesh(i);
        for (size_t i = 0; i < model_.cameras.size(); ++i) checkCamera(i);
        for (size_t i = 0; i < model_.skins.size(); ++i) checkSkin(i);
    }

private:
    void checkImage(size_t index) const {
        const tinygltf::Image& image = model_.images[index];
        checkIndex(label("image", index, image.name), "buffer view", image.bufferView,
                   model_.bufferViews.size(), Need::Optional);
    }

    void checkTexture(size_t index) const {
        const tinygltf::Texture& texture = model_.textures[index];
        const std::string owner = label("texture", index, texture.name);
        checkIndex(owner, "image", texture.source, model_.images.size(), Need::Optional);
        checkIndex(owner, "sampler", texture.sampler, model_.samplers.size(), Need::Optional);
    }

    void checkSampler(size_t index) const {
        const tinygltf::Sampler& sampler = model_.samplers[index];
        for (const int wrap : {sampler.wrapS, sampler.wrapT})
            if (wrap != TINYGLTF_TEXTURE_WRAP_REPEAT && wrap != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE &&
                wrap != TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT)
                source_.refuse("{}: VALUE_NOT_IN_LIST: wrap mode {}", label("sampler", index, sampler.name),
                               wrap);
    }

    void checkMaterial(size_t index) const {
        const tinygltf::Material& material = model_.materials[index];
        const std::string owner = label("material", index, material.name);
        const auto& pbr = material.pbrMetallicRoughness;
        for (const int texture :
             {pbr.baseColorTexture.index, pbr.metallicRoughnessTexture.index, material.normalTexture.index,
              material.occlusionTexture.index, material.emissiveTexture.index})
            checkIndex(owner, "texture", texture, model_.textures.size(), Need::Optional);
        for (const auto& [name, extension] : material.extensions) {
            for (const std::string& key : extension.Keys()) {
                const tinygltf::Value& texture = extension.Get(key);
                if (texture.IsObject() && texture.Has("index"))
                    checkIndex(owner + " " + name, "texture", texture.Get("index").GetNumberAsInt(),
                               model_.textures.size(), Need::Required);
            }
        }
    }

    void checkMesh(size_t index) const {
        const tinygltf::Mesh& mesh = model_.meshes[index];
        for (size_t p = 0; p < mesh.primitives.size(); ++p) {
            const tinygltf::Primitive& primitive = mesh.primitives[p];
            const std::string owner = fmt::format("{} primitive {}", label("mesh", index, mesh.name), p);
            checkIndex(owner, "material", primitive.material, model_.materials.size(), Need::Optional);
            if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
                source_.refuse("{}: VALUE_NOT_IN_LIST: mode {}", owner, primitive.mode);
            checkIndices(owner, primitive);
            for (const auto& [name, accessor] : primitive.attributes)
                checkAttribute(owner, primitive, name, accessor);
            for (const auto& target : primitive.targets)
                for (const auto& [name, accessor] : target) checkAttribute(owner, primitive, name, accessor);
        }
    }

    void checkIndices(const std::string& owner, const tinygltf::Primitive& primitive) const {
        checkIndex(owner, "accessor", primitive.indices, model_.accessors.size(), Need::Optional);
        if (primitive.indices == -1) return;
        const tinygltf::Accessor& accessor = model_.accessors[primitive.indices];
        if (accessor.type != TINYGLTF_TYPE_SCALAR || !isIndexType(accessor.componentType) ||
            accessor.normalized)
            source_.refuse("{}: MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT: accessor {}", owner,
                           primitive.indices);
    }

    void checkAttribute(const std::string& owner, const tinygltf::Primitive& primitive,
                        const std::string& name, int index) const {
        const std::string what = owner + " " + name;
        checkIndex(what, "accessor", index, model_.accessors.size(), Need::Required);
        const tinygltf::Accessor& accessor = model_.accessors[index];
        const bool vec2 = name.starts_with("TEXCOORD_");
        const bool vec3 = name == "POSITION" || name == "NORMAL";
        if ((vec2 && accessor.type != TINYGLTF_TYPE_VEC2) || (vec3 && accessor.type != TINYGLTF_TYPE_VEC3))
            source_.refuse("{}: MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT: accessor {}", what, index);
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) return;
        checkIndex(owner + " POSITION", "accessor", position->second, model_.accessors.size(),
                   Need::Required);
        const uint64_t vertices = model_.accessors[position->second].count;
        if (accessor.count != vertices)
            source_.refuse("{}: MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT: {} for {} positions", what,
                           accessor.count, vertices);
    }

    void checkCamera(size_t index) const {
        const tinygltf::Camera& camera = model_.cameras[index];
        const double fov = camera.perspective.yfov; // radians
        const double height = std::abs(camera.orthographic.ymag);
        if (camera.type == "orthographic" && !(height > 1e-30 && height < 1e30))
            source_.refuse("{}: VALUE_NOT_IN_RANGE: ymag {}", label("camera", index, camera.name),
                           camera.orthographic.ymag);
        if (camera.type == "perspective" && !(fov > 1e-6 && fov < 3.14159265))
            source_.refuse("{}: VALUE_NOT_IN_RANGE: yfov {}", label("camera", index, camera.name), fov);
    }

    void checkSkin(size_t index) const {
        const tinygltf::Skin& skin = model_.skins[index];
        const std::string owner = label("skin", index, skin.name);
        checkIndex(owner, "accessor", skin.inverseBindMatrices, model_.accessors.size(), Need::Optional);
        checkIndex(owner, "node", skin.skeleton, model_.nodes.size(), Need::Optional);
        for (const int joint : skin.joints)
            checkIndex(owner, "node", joint, model_.nodes.size(), Need::Required);
    }
};

} // namespace

void validateModel(const SourceFile& source, const tinygltf::Model& model) {
    checkData(source, model);
    ThingCheck(source, model).checkAll();
    checkNodes(source, model);
}

} // namespace irradia::gltf
