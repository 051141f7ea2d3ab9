#include "engine/scene/scene_box.h"

#include <algorithm>
#include <vector>

namespace irradia {
namespace {

constexpr double kStrayShare = 0.01; // of the area, at each face of the core
constexpr float kReach = 8.0f;       // times the core's longest edge

struct Weighted {
    float value;
    double weight;
};

// The largest value that has no more than `share` of the weight below it.
float quantile(std::vector<Weighted>& values, double share) {
    auto begin = values.begin(), end = values.end();
    double below = 0.0, limit = 0.0;
    for (const Weighted& v : values) limit += share * v.weight;
    // The answer is in [begin, end); `below` weighs what comes before.
    while (end - begin > 1) {
        const auto middle = begin + (end - begin) / 2;
        std::nth_element(begin, middle, end,
                         [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
        double half = below;
        for (auto v = begin; v != middle; ++v) half += v->weight;
        if (half > limit)
            end = middle;
        else
            begin = middle, below = half;
    }
    return begin->value;
}

std::vector<Bounds> triangleBounds(const Scene& scene) {
    std::vector<Bounds> boxes;
    boxes.reserve(scene.triangles.size());
    for (const Triangle& triangle : scene.triangles) {
        const glm::vec3 a = scene.vertices[triangle.vertex.x].position,
                        b = scene.vertices[triangle.vertex.y].position,
                        c = scene.vertices[triangle.vertex.z].position;
        boxes.push_back({glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)});
    }
    return boxes;
}

std::vector<double> triangleAreas(const Scene& scene) {
    std::vector<double> areas;
    areas.reserve(scene.triangles.size());
    for (const Triangle& triangle : scene.triangles) {
        const glm::dvec3 a(scene.vertices[triangle.vertex.x].position),
            b(scene.vertices[triangle.vertex.y].position), c(scene.vertices[triangle.vertex.z].position);
        areas.push_back(0.5 * glm::length(glm::cross(b - a, c - a)));
    }
    return areas;
}

Bounds coreOf(const std::vector<Bounds>& boxes, const std::vector<double>& areas) {
    Bounds core;
    std::vector<Weighted> values(boxes.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (size_t i = 0; i < boxes.size(); ++i) values[i] = {boxes[i].lower[axis], areas[i]};
        core.lower[axis] = quantile(values, kStrayShare);
        for (size_t i = 0; i < boxes.size(); ++i) values[i] = {-boxes[i].upper[axis], areas[i]};
        core.upper[axis] = std::max(-quantile(values, kStrayShare), core.lower[axis]);
    }
    return core;
}

bool holds(const Bounds& outer, const Bounds& inner) {
    return glm::all(glm::lessThanEqual(outer.lower, inner.lower)) &&
           glm::all(glm::lessThanEqual(inner.upper, outer.upper));
}

} // namespace

Bounds sceneBox(const Scene& scene) {
    const Bounds all = sceneBounds(scene);
    if (scene.triangles.empty()) return all;
    const std::vector<Bounds> boxes = triangleBounds(scene);
    const Bounds core = coreOf(boxes, triangleAreas(scene));
    const glm::vec3 extent = core.upper - core.lower;
    const glm::vec3 reach(kReach * std::max({extent.x, extent.y, extent.z}));
    const Bounds limit{core.lower - reach, core.upper + reach};
    if (holds(limit, all)) return all;

    Bounds box = core;
    for (const Bounds& b : boxes) {
        const Bounds part{glm::max(b.lower, limit.lower), glm::min(b.upper, limit.upper)};
        if (!glm::all(glm::lessThanEqual(part.lower, part.upper))) continue;
        box.lower = glm::min(box.lower, part.lower);
        box.upper = glm::max(box.upper, part.upper);
    }
    return box;
}

} // namespace irradia
