// A skin at the rest of its joints (glTF 2.0, 3.7.3).
#pragma once

#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/pose.h"
#include "engine/scene/scene.h"

namespace irradia::gltf {

class Skinning {
public:
    Skinning(const SourceFile& source, const tinygltf::Model& model, const tinygltf::Primitive& primitive,
             const Thing& owner, const Pose& pose);

    // Moves the primitive's vertex i to where its joints hold it. Throws BadData for a joint that is not
    // there. Weights are taken relative to their sum; where there are none, of the first joint alone.
    void apply(uint64_t i, Vertex& vertex);

    // Warns of the weights that were mended.
    void noteMends() const;

private:
    struct Set {
        AccessorView joints, weights; // four a vertex
    };
    glm::dmat4 blend(uint64_t i);

    const SourceFile& source_;
    const Thing& owner_;
    const Pose& pose_;
    std::vector<Set> sets_;
    bool badWeights_ = false, noWeights_ = false;
};

} // namespace irradia::gltf
