// EXT_mesh_gpu_instancing: a node's mesh that stands several times. The node's children do not.
#pragma once

#include "engine/scene/gltf/accessors.h"
#include <optional>

namespace irradia::gltf {

inline constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

// The model has passed validateModel, and must outlive this.
class Instancing {
public:
    Instancing() = default; // stands once
    Instancing(const tinygltf::Model& model, const tinygltf::Node& node);

    uint64_t count() const { return count_; }

    // Of instance i, within the node.
    glm::dmat4 transform(uint64_t i) const;

private:
    std::optional<AccessorView> translations_, rotations_, scales_;
    uint64_t count_ = 1;
};

} // namespace irradia::gltf
