// Closest and any intersection of rays with triangles: a binary hierarchy by binned surface-area heuristic
// (Wald 2007, "On fast construction of SAH-based bounding volume hierarchies") and Moeller and Trumbore's
// test (1997).
#pragma once

#include "tests/reference/math.h"
#include <cstdint>
#include <optional>
#include <vector>

namespace irradia::reference {

struct Ray {
    Vec3 origin{0.0};
    Vec3 direction{0.0, 0.0, 1.0}; // unit
};

struct Hit {
    double distance = 0.0;
    double u = 0.0, v = 0.0; // p = p0 + u e1 + v e2
    uint32_t triangle = 0;
};

struct TriangleShape {
    Vec3 p0{0.0}, e1{0.0}, e2{0.0};
};

struct Box {
    Vec3 lower{1e300}, upper{-1e300};

    void include(const Vec3& p) { lower = glm::min(lower, p), upper = glm::max(upper, p); }
    void include(const Box& b) { lower = glm::min(lower, b.lower), upper = glm::max(upper, b.upper); }
    double halfArea() const {
        const Vec3 d = glm::max(upper - lower, Vec3(0.0));
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
};

class Bvh {
public:
    explicit Bvh(std::vector<TriangleShape> triangles);

    // The nearest hit with from < distance < limit, from either side.
    std::optional<Hit> closest(const Ray& ray, double limit = 1e300, double from = 0.0) const;
    bool isOccluded(const Ray& ray, double limit) const;

    const TriangleShape& shape(uint32_t triangle) const { return triangles_[triangle]; }

private:
    struct Node {
        Box box;
        uint32_t first = 0; // of the leaf's triangles in order_, or the left child (the right one follows it)
        uint32_t count = 0; // 0 = inner node
    };
    void build(uint32_t node, uint32_t first, uint32_t last, int depth, const std::vector<Box>& boxes);
    template <bool kAny>
    std::optional<Hit> traverse(const Ray& ray, double from, double limit) const;

    std::vector<TriangleShape> triangles_; // as given
    std::vector<uint32_t> order_;          // triangles by leaf
    std::vector<TriangleShape> ordered_;   // triangles_ in that order
    std::vector<Node> nodes_;
};

} // namespace irradia::reference
