#include "engine/scene/gltf/skinning.h"

#include <cmath>

namespace irradia::gltf {

Skinning::Skinning(const SourceFile& source, const tinygltf::Model& model,
                   const tinygltf::Primitive& primitive, const Thing& owner, const Pose& pose)
    : source_(source)
    , owner_(owner)
    , pose_(pose) {
    for (int set = 0; !pose.joints.empty(); ++set) {
        const auto joints = primitive.attributes.find(fmt::format("JOINTS_{}", set));
        const auto weights = primitive.attributes.find(fmt::format("WEIGHTS_{}", set));
        if (joints == primitive.attributes.end() || weights == primitive.attributes.end()) return;
        sets_.push_back({AccessorView(model, joints->second), AccessorView(model, weights->second)});
    }
}

glm::dmat4 Skinning::blend(uint64_t i) {
    glm::dmat4 matrix(0.0);
    double sum = 0;
    for (const Set& set : sets_) {
        const glm::uvec4 joints = set.joints.integers(i);
        const glm::vec4 weights = set.weights.element(i);
        for (int c = 0; c < 4; ++c) {
            if (!(weights[c] >= 0.0f) || !std::isfinite(weights[c])) badWeights_ = true;
            if (!(weights[c] > 0.0f) || !std::isfinite(weights[c])) continue;
            if (joints[c] >= pose_.joints.size())
                source_.refuse(owner_.at("attributes"), "ACCESSOR_JOINTS_INDEX_OOB",
                               "vertex {} hangs on joint {} of {}", i, joints[c], pose_.joints.size());
            matrix += double{weights[c]} * pose_.joints[joints[c]];
            sum += weights[c];
        }
    }
    if (sum > 0) return matrix / sum;
    noWeights_ = true;
    return pose_.joints.front();
}

void Skinning::noteMends() const {
    if (badWeights_)
        source_.warn(owner_, "ACCESSOR_INVALID_FLOAT",
                     "weights of joints that are negative or not finite are taken as 0");
    if (noWeights_)
        source_.warn(owner_, "ACCESSOR_WEIGHTS_NON_NORMALIZED",
                     "vertices without a weight above 0 hang on the skin's first joint");
}

void Skinning::apply(uint64_t i, Vertex& vertex) {
    if (sets_.empty()) return;
    const glm::dmat4 matrix = blend(i);
    const glm::dmat3 linear(matrix);
    vertex.position = matrix * glm::dvec4(vertex.position, 1.0);
    // As for instances: normals go by the cofactors, up to a positive factor, tangents by the matrix.
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    const double sign = glm::determinant(linear) < 0 ? -1.0 : 1.0;
    const auto unit = [](const glm::dvec3& v) { // small models have tiny cofactors
        const double length = glm::length(v);
        return length > 0 ? v / length : v;
    };
    vertex.normal = unit(sign * (cofactors * glm::dvec3(vertex.normal)));
    vertex.tangent = glm::dvec4(unit(linear * glm::dvec3(vertex.tangent)), sign * vertex.tangent.w);
}

} // namespace irradia::gltf
