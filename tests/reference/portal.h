// An opening through which most of the light comes, a parallelogram: towards it paths are sampled too, not by
// the BSDF alone. Any portal leaves the expectation as it is; one in a doorway makes the dark room cheap.
#pragma once

#include "tests/reference/math.h"

namespace irradia::reference {

struct Portal {
    Vec3 corner{0.0}, edge1{0.0}, edge2{0.0};
    Vec3 normal = glm::normalize(glm::cross(edge1, edge2)); // of the front, which looks at the dark room
    double area = glm::length(glm::cross(edge1, edge2));

    // Is a point before the front? Only from there is the portal sampled.
    bool faces(const Vec3& from) const { return glm::dot(from - corner, normal) > 0.0; }

    // Unit direction to a point distributed uniformly over the portal.
    Vec3 sample(const Vec3& from, const Vec2& u) const {
        return glm::normalize(corner + u.x * edge1 + u.y * edge2 - from);
    }

    // Density of that direction, 1/sr; 0 where it misses the portal.
    double pdf(const Vec3& from, const Vec3& direction) const {
        const double height = glm::dot(from - corner, normal), cosine = -glm::dot(direction, normal);
        if (height <= 0.0 || cosine <= 0.0) return 0.0;
        const double distance = height / cosine;
        const Vec3 met = from + distance * direction - corner;
        const Vec3 cross = glm::cross(edge1, edge2);
        const Vec2 uv =
            Vec2(glm::dot(glm::cross(met, edge2), cross), glm::dot(glm::cross(edge1, met), cross)) /
            glm::dot(cross, cross);
        const bool isInside = uv.x >= 0.0 && uv.x <= 1.0 && uv.y >= 0.0 && uv.y <= 1.0;
        return isInside ? distance * distance / (area * cosine) : 0.0;
    }
};

} // namespace irradia::reference
