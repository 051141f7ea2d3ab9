#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/model_check.h"
#include <algorithm>

namespace irradia::gltf {
namespace {

class SkinCheck : private ModelCheck {
public:
    using ModelCheck::ModelCheck;

    bool checkAll() const {
        const bool isGood = each(model_.skins, [&](size_t i) { checkSkin(i); });
        return each(model_.nodes, [&](size_t i) { checkNode(i); }) && isGood;
    }

private:
    void checkSkin(size_t index) const {
        const tinygltf::Skin& skin = model_.skins[index];
        const Thing owner = thing("skin", "skins", index, skin.name);
        checkIndex(owner.at("skeleton"), "node", skin.skeleton, model_.nodes.size(), Need::Optional);
        if (skin.joints.empty()) source_.refuse(owner.at("joints"), "EMPTY_ENTITY", "it has no joints");
        for (const int joint : skin.joints)
            checkIndex(owner.at("joints"), "node", joint, model_.nodes.size(), Need::Required);
        checkMatrices(owner.at("inverseBindMatrices"), skin);
    }

    void checkMatrices(const Thing& owner, const tinygltf::Skin& skin) const {
        const int index = skin.inverseBindMatrices;
        checkIndex(owner, "accessor", index, model_.accessors.size(), Need::Optional);
        if (index == -1) return;
        const tinygltf::Accessor& accessor = model_.accessors[index];
        if (accessor.type != TINYGLTF_TYPE_MAT4 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
            source_.refuse(owner, "SKIN_IBM_INVALID_FORMAT", "accessor {}", index);
        if (accessor.count < skin.joints.size())
            source_.refuse(owner, "INVALID_IBM_ACCESSOR_COUNT", "{} matrices for {} joints", accessor.count,
                           skin.joints.size());
    }

    void checkNode(size_t index) const {
        const tinygltf::Node& node = model_.nodes[index];
        const Thing owner = thing("node", "nodes", index, node.name);
        const bool hasMesh = node.mesh >= 0 && static_cast<size_t>(node.mesh) < model_.meshes.size();
        if (!hasMesh) return; // which is told with the node
        if (!node.weights.empty()) checkWeights(owner, node);
        const auto hangs = [](const tinygltf::Primitive& primitive) {
            return primitive.attributes.contains("JOINTS_0") && primitive.attributes.contains("WEIGHTS_0");
        };
        const tinygltf::Mesh& mesh = model_.meshes[node.mesh];
        if (node.skin >= 0 && !std::ranges::all_of(mesh.primitives, hangs))
            source_.warn(owner.at("skin"), "NODE_SKIN_WITH_NON_SKINNED_MESH",
                         "primitives without JOINTS_0 and WEIGHTS_0 stay where the skin's mesh is");
    }

    void checkWeights(const Thing& owner, const tinygltf::Node& node) const {
        for (const tinygltf::Primitive& primitive : model_.meshes[node.mesh].primitives)
            if (primitive.targets.size() != node.weights.size())
                source_.refuse(owner.at("weights"), "NODE_WEIGHTS_INVALID", "{} weights for {} morph targets",
                               node.weights.size(), primitive.targets.size());
    }
};

} // namespace

bool checkSkins(const SourceFile& source, const tinygltf::Model& model) {
    return SkinCheck(source, model).checkAll();
}

} // namespace irradia::gltf
