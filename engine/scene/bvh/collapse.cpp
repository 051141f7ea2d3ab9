#include "engine/scene/bvh/collapse.h"
#include <algorithm>

namespace irradia {
namespace {

constexpr uint32_t kWidth = gpu::kBvhWidth;

float halfArea(const Bounds& b) {
    const glm::vec3 d = b.upper - b.lower;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

} // namespace

Collapse::Collapse(const BinaryTree& tree, bool balanced)
    : tree_(tree)
    , plans_(tree.size()) {
    for (auto i = static_cast<uint32_t>(tree.size()); i-- > 0;)
        plans_[i] = planOf(i, balanced); // children first
}

// The unit of cost is a traversal step: the kernels take one for a node and one for a triangle, whence leaves
// of one triangle (leaves of two save no steps).
Collapse::Plan Collapse::planOf(uint32_t node, bool balanced) const {
    Plan plan;
    const float area = halfArea(tree_[node].bounds);
    if (tree_[node].isLeaf()) {
        std::fill_n(plan.cost, kWidth, area);
        return plan;
    }
    const Plan& left = plans_[node + 1];
    const Plan& right = plans_[tree_[node].right];
    for (uint32_t j = 2; j <= kWidth; ++j) {
        const uint32_t fewest = balanced ? j / 2 : 1;
        const uint32_t most = balanced ? j / 2 : j - 1;
        plan.leftRoots[j] = static_cast<uint8_t>(fewest);
        plan.cost[j] = left.cost[fewest] + right.cost[j - fewest];
        for (uint32_t k = fewest + 1; k <= most; ++k) {
            const float cost = left.cost[k] + right.cost[j - k];
            if (cost >= plan.cost[j]) continue;
            plan.cost[j] = cost;
            plan.leftRoots[j] = static_cast<uint8_t>(k);
        }
    }
    plan.cost[1] = area + plan.cost[kWidth];
    for (uint32_t j = 2; j < kWidth && !balanced; ++j)
        if (plan.cost[j - 1] <= plan.cost[j]) {
            plan.cost[j] = plan.cost[j - 1];
            plan.leftRoots[j] = 0;
        }
    return plan;
}

std::vector<uint32_t> Collapse::childrenOf(uint32_t node) const {
    std::vector<uint32_t> children;
    collect(node, kWidth, children);
    return children;
}

void Collapse::collect(uint32_t node, uint32_t roots, std::vector<uint32_t>& children) const {
    const Plan& plan = plans_[node];
    while (roots > 1 && plan.leftRoots[roots] == 0) --roots;
    if (roots == 1) {
        children.push_back(node);
        return;
    }
    collect(node + 1, plan.leftRoots[roots], children);
    collect(tree_[node].right, roots - plan.leftRoots[roots], children);
}

} // namespace irradia
