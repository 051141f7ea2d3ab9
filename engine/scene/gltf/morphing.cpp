#include "engine/scene/gltf/morphing.h"

namespace irradia::gltf {

Morphing::Morphing(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const Pose& pose) {
    const size_t count = std::min(primitive.targets.size(), pose.weights.size());
    for (size_t t = 0; t < count; ++t) {
        const auto& from = primitive.targets[t];
        const auto view = [&](const std::string& name, std::optional<AccessorView>& to) {
            if (const auto found = from.find(name); found != from.end()) to.emplace(model, found->second);
        };
        if (pose.weights[t] == 0.0) continue;
        Target& target = targets_.emplace_back();
        target.weight = static_cast<float>(pose.weights[t]);
        view("POSITION", target.positions);
        view("NORMAL", target.normals);
        view("TANGENT", target.tangents);
    }
}

void Morphing::apply(uint64_t i, Vertex& vertex) const {
    for (const Target& target : targets_) {
        if (target.positions) vertex.position += target.weight * glm::vec3(target.positions->element(i));
        if (target.normals) vertex.normal += target.weight * glm::vec3(target.normals->element(i));
        if (target.tangents) // whose targets have no handedness
            vertex.tangent += glm::vec4(target.weight * glm::vec3(target.tangents->element(i)), 0.0f);
    }
}

} // namespace irradia::gltf
