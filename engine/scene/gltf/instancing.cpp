#include "engine/scene/gltf/instancing.h"

#include "engine/scene/gltf/nodes.h"
#include "engine/scene/gltf/values.h"

namespace irradia::gltf {

Instancing::Instancing(const tinygltf::Model& model, const tinygltf::Node& node) {
    const Extension extension = findExtension(node.extensions, kInstancing);
    if (!extension) return;
    const tinygltf::Value& attributes = member(*extension, "attributes");
    const auto read = [&](const std::string& name, std::optional<AccessorView>& view) {
        if (!attributes.Has(name)) return;
        view.emplace(model, attributes.Get(name).GetNumberAsInt());
        count_ = view->count();
    };
    read("TRANSLATION", translations_);
    read("ROTATION", rotations_);
    read("SCALE", scales_);
}

glm::dmat4 Instancing::transform(uint64_t i) const {
    const glm::dvec3 translation = translations_ ? glm::dvec3(translations_->element(i)) : glm::dvec3(0.0);
    const glm::dvec3 scale = scales_ ? glm::dvec3(scales_->element(i)) : glm::dvec3(1.0);
    const glm::dvec4 rotation = rotations_ ? glm::dvec4(rotations_->element(i)) : glm::dvec4(0, 0, 0, 1);
    return transformOf(translation, rotation, scale);
}

} // namespace irradia::gltf
