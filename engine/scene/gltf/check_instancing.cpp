#include "engine/scene/gltf/instancing.h"
#include "engine/scene/gltf/model_check.h"
#include "engine/scene/gltf/values.h"

namespace irradia::gltf {
namespace {

class InstancingCheck : private ModelCheck {
public:
    using ModelCheck::ModelCheck;

    bool checkAll() const {
        return each(model_.nodes, [&](size_t i) { checkNode(i); });
    }

private:
    void checkNode(size_t index) const {
        const tinygltf::Node& node = model_.nodes[index];
        const Extension extension = findExtension(node.extensions, kInstancing);
        if (!extension) return;
        const Thing owner =
            thing("node", "nodes", index, node.name).at("extensions").at(kInstancing).at("attributes");
        const tinygltf::Value& attributes = member(*extension, "attributes");
        if (!attributes.IsObject()) return;
        uint64_t count = 0;
        for (const std::string& name : attributes.Keys()) {
            const Thing at = owner.called(name).at(name);
            const int accessor = attributes.Get(name).GetNumberAsInt();
            checkIndex(at, "accessor", accessor, model_.accessors.size(), Need::Required);
            checkFormat(at, name, model_.accessors[accessor]);
            if (count != 0 && model_.accessors[accessor].count != count)
                source_.refuse(at, "INSTANCING_UNEQUAL_ACCESSOR_COUNT",
                               "{} instances, another attribute has {}", model_.accessors[accessor].count,
                               count);
            count = model_.accessors[accessor].count;
        }
    }

    void checkFormat(const Thing& at, const std::string& name, const tinygltf::Accessor& accessor) const {
        const int type = accessor.componentType;
        const bool isFloat = type == TINYGLTF_COMPONENT_TYPE_FLOAT;
        const bool isPacked = accessor.normalized &&
                              (type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_SHORT);
        bool isGood = true; // of attributes of the file's own
        if (name == "TRANSLATION" || name == "SCALE") isGood = accessor.type == TINYGLTF_TYPE_VEC3 && isFloat;
        if (name == "ROTATION") isGood = accessor.type == TINYGLTF_TYPE_VEC4 && (isFloat || isPacked);
        if (!isGood)
            source_.refuse(
                at, "INSTANCING_ACCESSOR_INVALID_FORMAT", "an accessor of another format is needed: {}",
                name == "ROTATION" ? "VEC4 of floats or of normalised bytes or shorts" : "VEC3 of floats");
    }
};

} // namespace

bool checkInstancing(const SourceFile& source, const tinygltf::Model& model) {
    return InstancingCheck(source, model).checkAll();
}

} // namespace irradia::gltf
