#include "tests/reference/light_tree.h"

#include <algorithm>
#include <cmath>

namespace irradia::reference {

namespace {

// Eq. 3 for the lights of a node: power / d^2 cos(theta'), theta' = max(theta - theta_o - theta_u, 0),
// emission over a hemisphere, without the receiver's cosine. Within the sphere every direction is possible,
// and the distance its radius.
double importance(const LightTreeNode& node, const Vec3& point) {
    const Vec3 v = point - node.center;
    const double distance = glm::length(v);
    if (distance <= node.radius) return node.power / (node.radius * node.radius);
    const double toAxis = std::acos(std::clamp(glm::dot(node.axis, v) / distance, -1.0, 1.0));
    const double uncertain = std::asin(node.radius / distance);
    const double angle = std::max(toAxis - node.spread - uncertain, 0.0);
    return angle < kPi / 2.0 ? node.power * std::cos(angle) / (distance * distance) : 0.0;
}

void descend(const LightTree& tree, uint32_t at, double chance, const Vec3& point,
             std::vector<double>& chances) {
    const LightTreeNode& node = tree.nodes[at];
    if (node.isLeaf) {
        chances[node.child] = chance;
        return;
    }
    const double first = importance(tree.nodes[node.child], point);
    const double second = importance(tree.nodes[node.child + 1], point);
    if (first + second == 0.0) return;
    descend(tree, node.child, chance * first / (first + second), point, chances);
    descend(tree, node.child + 1, chance * second / (first + second), point, chances);
}

} // namespace

std::vector<double> lightChances(const LightTree& tree, const Vec3& point) {
    std::vector<double> chances(tree.trails.size(), 0.0);
    descend(tree, 0, 1.0, point, chances);
    return chances;
}

} // namespace irradia::reference
