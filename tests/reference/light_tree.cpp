#include "tests/reference/light_tree.h"

#include <algorithm>
#include <cmath>

namespace irradia::reference {

namespace {

// Cosine of an angle in excess of others, 0 where it is a right one or more.
double cosine(double excess) {
    return excess < kPi / 2.0 ? std::cos(std::max(excess, 0.0)) : 0.0;
}

double angleBetween(const Vec3& a, const Vec3& b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

// Importance of the lights of a node: power / d^2 cos(theta') cos(theta_i'), theta' = max(theta - theta_o -
// theta_u, 0), theta_i' = max(theta_i - theta_u, 0); none where theta' is more than theta_e. Within the
// sphere every direction is possible, and the distance its radius.
double importance(const LightNode& node, const Receiver& receiver) {
    const Vec3 v = receiver.point - node.center;
    const double distance = glm::length(v);
    if (distance <= node.radius) return node.power / (node.radius * node.radius);
    const double uncertain = std::asin(node.radius / distance);
    const double emitted = angleBetween(node.axis, v / distance) - node.spread - uncertain;
    if (emitted > node.reach) return 0.0;
    return node.power / (distance * distance) * cosine(emitted) *
           cosine(angleBetween(receiver.normal, -v / distance) - uncertain);
}

void descend(const std::vector<LightNode>& tree, uint32_t at, double chance, const Receiver& receiver,
             std::vector<double>& chances) {
    const LightNode& node = tree[at];
    if (node.isLeaf) {
        chances[node.child] = chance;
        return;
    }
    const double first = importance(tree[node.child], receiver);
    const double second = importance(tree[node.child + 1], receiver);
    if (first + second == 0.0) return;
    descend(tree, node.child, chance * first / (first + second), receiver, chances);
    descend(tree, node.child + 1, chance * second / (first + second), receiver, chances);
}

} // namespace

std::vector<double> lightChances(const std::vector<LightNode>& tree, const Receiver& receiver) {
    std::vector<double> chances((tree.size() + 1) / 2, 0.0);
    descend(tree, 0, 1.0, receiver, chances);
    return chances;
}

} // namespace irradia::reference
