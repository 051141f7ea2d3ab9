#include "engine/scene/lights/light_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace irradia {

namespace {

using glm::dvec3;
using Range = std::span<uint32_t>;

struct Box {
    dvec3 lower{std::numeric_limits<double>::max()};
    dvec3 upper{std::numeric_limits<double>::lowest()};

    void add(const dvec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    double area() const {
        const dvec3 e = upper - lower;
        return 2.0 * (e.x * e.y + e.y * e.z + e.z * e.x);
    }
};

// Integral over directions of the cosine to the nearest of a cone's normals: the paper's orientation
// measure.
double coneMeasure(const EmissionCone& cone) {
    const double spread = cone.spread, end = std::min(spread + cone.reach, std::numbers::pi);
    return 2.0 * std::numbers::pi * (1.0 - std::cos(spread)) +
           0.5 * std::numbers::pi *
               (2.0 * end * std::sin(spread) - std::cos(spread - 2.0 * end) -
                2.0 * spread * std::sin(spread) + std::cos(spread));
}

EmissionCone coneOf(const TreeLight& light) {
    if (light.cone) return *light.cone;
    const auto& [a, b, c] = light.corners;
    const dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    return {length > 0.0 ? normal / length : dvec3(0.0), light.isTwoSided ? std::numbers::pi : 0.0};
}

class Builder {
public:
    explicit Builder(std::span<const TreeLight> lights)
        : lights_(lights) {
        for (const TreeLight& light : lights) {
            const auto& [a, b, c] = light.corners;
            cones_.push_back(coneOf(light));
            centroids_.push_back((a + b + c) / 3.0);
        }
        tree_.trails.resize(lights.size());
        tree_.nodes.reserve(2 * lights.size());
    }

    LightTree build() {
        std::vector<uint32_t> order(lights_.size());
        std::iota(order.begin(), order.end(), 0u);
        tree_.nodes.emplace_back();
        buildNode(0, order, 0, 0);
        return std::move(tree_);
    }

private:
    void buildNode(size_t at, Range part, uint32_t depth, uint32_t trail) {
        LightTreeNode node = bounds(part);
        node.isLeaf = part.size() == 1;
        if (node.isLeaf) {
            node.child = part[0];
            tree_.trails[part[0]] = trail;
            tree_.nodes[at] = node;
            return;
        }
        const size_t middle = split(part, depth);
        const auto child = static_cast<uint32_t>(tree_.nodes.size());
        node.child = child;
        tree_.nodes[at] = node;
        tree_.nodes.resize(child + 2);
        buildNode(child, part.first(middle), depth + 1, trail);
        buildNode(child + 1, part.subspan(middle), depth + 1, trail | 1u << depth);
    }

    LightTreeNode bounds(Range part) const {
        LightTreeNode node;
        const Box box = boxOf(part);
        node.center = 0.5 * (box.lower + box.upper);
        for (const uint32_t i : part) {
            node.power += lights_[i].power;
            for (const dvec3& p : lights_[i].corners)
                node.radius = std::max(node.radius, glm::distance(p, node.center));
        }
        node.cone = coneAround(part);
        return node;
    }

    Box boxOf(Range part) const {
        Box box;
        for (const uint32_t i : part)
            for (const dvec3& p : lights_[i].corners) box.add(p);
        return box;
    }

    EmissionCone coneAround(Range part) const {
        EmissionCone cone{coneAxis(part), 0.0, 0.0};
        cone.spread = coneSpread(part, cone.axis);
        for (const uint32_t i : part) cone.reach = std::max(cone.reach, cones_[i].reach);
        return cone;
    }

    dvec3 coneAxis(Range part) const {
        dvec3 sum(0.0);
        for (const uint32_t i : part) sum += cones_[i].axis;
        const double length = glm::length(sum);
        return length > 1e-6 ? sum / length : dvec3(0, 0, 1);
    }

    double coneSpread(Range part, const dvec3& axis) const {
        double lowest = 1.0, widest = 0.0;
        for (const uint32_t i : part) {
            const EmissionCone& cone = cones_[i];
            if (cone.spread >= std::numbers::pi) return std::numbers::pi;
            const double cosine = std::clamp(glm::dot(axis, cone.axis), -1.0, 1.0);
            if (cone.spread > 0.0)
                widest = std::max(widest, std::acos(cosine) + cone.spread);
            else
                lowest = std::min(lowest, cosine);
        }
        return std::min(std::max(widest, std::acos(lowest)) + kConeMargin, std::numbers::pi);
    }

    // Reorders the part; returns the size of the first half, neither of which is empty. Of three planes, each
    // through the middle of an axis, the one of least cost (surface area orientation heuristic, without its
    // factor for thin boxes), or half of the lights where planes part none or would make the tree too deep.
    size_t split(Range part, uint32_t depth) const {
        Box box;
        for (const uint32_t i : part) box.add(centroids_[i]);
        const dvec3 extent = box.upper - box.lower, plane = 0.5 * (box.lower + box.upper);
        double least = std::numeric_limits<double>::max();
        int best = -1;
        if (depth + 1 + std::bit_width(part.size()) <= kMaxLightTreeDepth)
            for (int axis = 0; axis < 3; ++axis) {
                if (!(extent[axis] > 0.0)) continue;
                const size_t middle = divide(part, axis, plane[axis]);
                if (middle == 0 || middle == part.size()) continue;
                const double cost = costOf(part.first(middle)) + costOf(part.subspan(middle));
                if (cost >= least) continue;
                least = cost;
                best = axis;
            }
        if (best >= 0) return divide(part, best, plane[best]);
        const int widest = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const size_t half = part.size() / 2;
        std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(half), part.end(),
                         [&](uint32_t a, uint32_t b) {
                             return std::pair(centroids_[a][widest], a) < std::pair(centroids_[b][widest], b);
                         });
        return half;
    }

    size_t divide(Range part, int axis, double plane) const {
        const auto middle =
            std::partition(part.begin(), part.end(), [&](uint32_t i) { return centroids_[i][axis] < plane; });
        return static_cast<size_t>(middle - part.begin());
    }

    double costOf(Range part) const {
        double power = 0.0;
        for (const uint32_t i : part) power += lights_[i].power;
        return power * boxOf(part).area() * coneMeasure(coneAround(part));
    }

    std::span<const TreeLight> lights_;
    std::vector<EmissionCone> cones_;
    std::vector<dvec3> centroids_;
    LightTree tree_;
};

} // namespace

LightTree buildLightTree(std::span<const TreeLight> lights) {
    return Builder(lights).build();
}

} // namespace irradia
