#include "engine/scene/gltf/instances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradia::gltf {
namespace {

constexpr uint32_t kNone = ~0u;
constexpr double kMinRelativeArea = 1e-12; // of a triangle, to its longest edge squared

enum class Shape { Good, NonFinite, Degenerate };

struct Face {
    Shape shape;
    glm::vec3 normal; // unit if Good
};

Face measure(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    // Kernels normalise the cross product in float: what overflows or vanishes there is no triangle.
    const glm::vec3 cross = glm::cross(b - a, c - a);
    const float length2 = glm::dot(cross, cross);
    if (!std::isfinite(length2)) return {Shape::NonFinite, {}};
    if (length2 < std::numeric_limits<float>::min()) return {Shape::Degenerate, {}};
    // In double the product of float edges is exact enough to tell a sliver from nothing.
    const glm::dvec3 p(a), e1 = glm::dvec3(b) - p, e2 = glm::dvec3(c) - p, e3 = e2 - e1;
    const glm::dvec3 exact = glm::cross(e1, e2);
    const double area2 = glm::length(exact); // twice the area
    const double longest2 = std::max({glm::dot(e1, e1), glm::dot(e2, e2), glm::dot(e3, e3)});
    if (0.5 * area2 <= kMinRelativeArea * longest2) return {Shape::Degenerate, {}};
    return {Shape::Good, exact / area2};
}

glm::vec3 unitOrZero(glm::dvec3 v) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0.0f);
}

class Instance {
public:
    Instance(const PrimitiveMesh& mesh, const glm::dmat4& toWorld, Scene& scene)
        : mesh_(mesh)
        , toWorld_(toWorld)
        , linear_(toWorld)
        , mirrors_(glm::determinant(linear_) < 0)
        , scene_(scene) {
        // Normals go by the inverse transpose up to a positive factor: the cofactors, which need no inverse.
        normals_ = glm::dmat3(glm::cross(linear_[1], linear_[2]), glm::cross(linear_[2], linear_[0]),
                              glm::cross(linear_[0], linear_[1]));
        if (mirrors_) normals_ = -normals_;
    }

    void append() {
        positions_.reserve(mesh_.vertices.size());
        for (const Vertex& vertex : mesh_.vertices)
            positions_.emplace_back(toWorld_ * glm::dvec4(vertex.position, 1.0));
        slots_.assign(mesh_.vertices.size(), kNone);
        for (glm::uvec3 corners : mesh_.triangles) {
            if (mirrors_) std::swap(corners.y, corners.z); // a mirror turns the front to the back
            const Face face = measure(positions_[corners.x], positions_[corners.y], positions_[corners.z]);
            if (face.shape == Shape::NonFinite)
                ++scene_.notes.nonFiniteTriangles;
            else if (face.shape == Shape::Degenerate)
                ++scene_.notes.degenerateTriangles;
            else
                appendTriangle(corners, face.normal);
        }
    }

private:
    void appendTriangle(const glm::uvec3& corners, glm::vec3 flatNormal) {
        Triangle triangle;
        triangle.material = mesh_.material;
        for (int c = 0; c < 3; ++c) triangle.vertex[c] = worldVertex(corners[c], flatNormal);
        scene_.triangles.push_back(triangle);
    }

    uint32_t worldVertex(uint32_t local, glm::vec3 flatNormal) {
        uint32_t& slot = slots_[local];
        if (slot != kNone) return slot;
        Vertex vertex = mesh_.vertices[local];
        vertex.position = positions_[local];
        vertex.normal = unitOrZero(normals_ * glm::dvec3(vertex.normal));
        if (vertex.normal == glm::vec3(0.0f)) vertex.normal = flatNormal;
        vertex.tangent = worldTangent(vertex);
        slot = static_cast<uint32_t>(scene_.vertices.size());
        scene_.vertices.push_back(vertex);
        return slot;
    }

    // Tangents lie in the surface: they go by the matrix itself, then are made orthogonal to the normal
    // again.
    glm::vec4 worldTangent(const Vertex& vertex) const {
        const glm::dvec3 normal(vertex.normal);
        const glm::dvec3 moved(unitOrZero(linear_ * glm::dvec3(vertex.tangent)));
        const glm::dvec3 flattened = moved - normal * glm::dot(normal, moved);
        if (glm::length(flattened) < 1e-6) return glm::vec4(0.0f);
        return glm::vec4(unitOrZero(flattened), mirrors_ ? -vertex.tangent.w : vertex.tangent.w);
    }

    const PrimitiveMesh& mesh_;
    glm::dmat4 toWorld_;
    glm::dmat3 linear_;
    glm::dmat3 normals_{1.0};
    bool mirrors_;
    Scene& scene_;
    std::vector<glm::vec3> positions_; // world, rounded to float as the scene holds them
    std::vector<uint32_t> slots_;      // the scene's vertex by the primitive's
};

} // namespace

void appendInstance(const PrimitiveMesh& mesh, const glm::dmat4& toWorld, Scene& scene) {
    Instance(mesh, toWorld, scene).append();
}

} // namespace irradia::gltf
