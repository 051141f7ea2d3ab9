// Which nodes of a binary tree become the children of a 4-wide one.
#pragma once

#include "engine/scene/bvh/binary.h"
#include "shared/bvh.h"

namespace irradia {

class Collapse {
public:
    // By least expected cost (Ylitie et al. 2017, section 3.1); `balanced` takes two binary levels at a time
    // instead, which bounds the depth.
    Collapse(const BinaryTree& tree, bool balanced);

    // The binary nodes, at most four, that become the children of what `node` becomes; the tree's only node,
    // a leaf, is its own child.
    std::vector<uint32_t> childrenOf(uint32_t node) const;

private:
    // How a binary subtree is best represented as at most j nodes of the wide tree, 1 <= j <= 4.
    struct Plan {
        float cost[gpu::kBvhWidth + 1] = {}; // cost[4]: of the children alone
        uint8_t leftRoots[gpu::kBvhWidth + 1] =
            {}; // how many of the j go to the left child; 0 = j - 1 do as well
    };
    Plan planOf(uint32_t node, bool balanced) const;
    void collect(uint32_t node, uint32_t roots, std::vector<uint32_t>& children) const;

    const BinaryTree& tree_;
    std::vector<Plan> plans_; // by binary node
};

} // namespace irradia
