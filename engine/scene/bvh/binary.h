// A binary tree over triangle references, one per leaf: the raw material of buildBvh.
#pragma once

#include "engine/scene/scene.h"
#include <vector>

namespace irradia {

// Nodes in depth-first order: the left child of node i is i + 1.
struct BinaryNode {
    Bounds bounds;
    uint32_t right = 0;     // index of the right child; 0 = a leaf
    uint32_t primitive = 0; // of a leaf
    bool isLeaf() const { return right == 0; }
};

using BinaryTree = std::vector<BinaryNode>;

// Surface area heuristic with spatial splits by Embree's builder. Empty when the tree would be deeper than it
// allows.
BinaryTree buildSahTree(const Scene& scene, uint32_t threads, float splitReferences);

// Halves at the median of the centroids: poor to trace, but never deeper than log2(n) + 1.
BinaryTree buildMedianTree(const Scene& scene);

} // namespace irradia
