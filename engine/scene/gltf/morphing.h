// Morph targets at their weights of rest (glTF 2.0, 3.7.2.2).
#pragma once

#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/pose.h"
#include "engine/scene/scene.h"
#include <optional>

namespace irradia::gltf {

class Morphing {
public:
    Morphing(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const Pose& pose);

    // Moves position, normal and tangent of the primitive's vertex i.
    void apply(uint64_t i, Vertex& vertex) const;

private:
    struct Target {
        float weight;
        std::optional<AccessorView> positions, normals, tangents;
    };
    std::vector<Target> targets_; // of weight
};

} // namespace irradia::gltf
