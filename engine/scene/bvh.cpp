#include "engine/scene/bvh.h"
#include "engine/error.h"
#include "engine/scene/bvh_binary.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace irradia {
namespace {

constexpr uint64_t kBindingLimit = uint64_t{128}
                                   << 20; // bytes, the least maxStorageBufferRange in use (lavapipe)
constexpr uint32_t kWidth = gpu::kBvhWidth;
constexpr uint32_t kItem = gpu::kItemRecords;
constexpr uint32_t kMaxLeafTriangles = 2;

// Relative costs of a traversal step that meets a node and one that meets a triangle. The kernels do both in
// the same step, hence nearly the same.
constexpr float kNodeCost = 1.0f;
constexpr float kTriangleCost = 1.0f;

// How a binary subtree is best represented: as one child (a leaf or a node), or as up to j children of a node
// above.
struct Plan {
    float cost[kWidth]; // [j]: at most j roots, 1 <= j < kWidth
    uint8_t leftRoots[kWidth +
                      1]; // [j]: how many of j roots go to the left child; 0 = one root fewer does as well
    uint32_t triangles;
    bool leaf;
};

float halfArea(const Bounds& b) {
    const glm::vec3 d = b.upper - b.lower;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

// The collapse of least expected cost (Ylitie et al. 2017, section 3.1), children before parents.
// `balanced` takes two levels at a time instead, which bounds the depth.
std::vector<Plan> planCollapse(const BinaryTree& tree, bool balanced) {
    std::vector<Plan> plans(tree.size());
    for (size_t i = tree.size(); i-- > 0;) {
        Plan& plan = plans[i];
        plan = {};
        const float area = halfArea(tree[i].bounds);
        if (tree[i].isLeaf()) {
            plan.triangles = 1;
            plan.leaf = true;
            for (uint32_t j = 1; j < kWidth; ++j) plan.cost[j] = area * kTriangleCost;
            continue;
        }
        const Plan& left = plans[i + 1];
        const Plan& right = plans[tree[i].right];
        float cost[kWidth + 1] = {};
        for (uint32_t j = 2; j <= kWidth; ++j) {
            cost[j] = left.cost[1] + right.cost[j - 1];
            plan.leftRoots[j] = 1;
            for (uint32_t k = 2; k < j; ++k) {
                const float c = left.cost[k] + right.cost[j - k];
                if (c < cost[j] || (balanced && j == kWidth && k == 2)) {
                    cost[j] = c;
                    plan.leftRoots[j] = static_cast<uint8_t>(k);
                }
                if (balanced && j == kWidth && k == 2) break;
            }
        }
        plan.triangles = left.triangles + right.triangles;
        const float asLeaf = area * kTriangleCost * static_cast<float>(plan.triangles);
        const float asNode = area * kNodeCost + cost[kWidth];
        plan.leaf = plan.triangles <= kMaxLeafTriangles && asLeaf <= asNode;
        plan.cost[1] = plan.leaf ? asLeaf : asNode;
        for (uint32_t j = 2; j < kWidth; ++j) {
            plan.cost[j] = std::min(cost[j], plan.cost[j - 1]);
            if (plan.cost[j - 1] <= cost[j] && !balanced) plan.leftRoots[j] = 0;
        }
    }
    return plans;
}

float largestCoordinate(const Bounds& b) {
    const glm::vec3 m = glm::max(glm::abs(b.lower), glm::abs(b.upper));
    return std::max({m.x, m.y, m.z});
}

// (GLM's floatBitsToUint breaks strict aliasing, and under optimisation its result.)
glm::uvec3 bitsOf(const glm::vec3& v) {
    return std::bit_cast<glm::uvec3>(v);
}

// Writes the planned tree as records.
class Encoder {
public:
    Encoder(const Scene& scene, const BinaryTree& tree, const std::vector<Plan>& plans)
        : scene_(scene)
        , tree_(tree)
        , plans_(plans)
        , padding_(0x1p-21f * largestCoordinate(tree[0].bounds)) {}

    Bvh encode() {
        bvh_.records.resize(kItem);
        std::vector<Item> open{{0, 0, 1}}; // depth first: the block of the first inner child comes next
        while (!open.empty()) {
            const Item item = open.back();
            open.pop_back();
            const std::vector<uint32_t> children = childrenOf(item.node);
            const uint32_t base = items();
            bvh_.maxDepth = std::max(bvh_.maxDepth, item.depth);
            emitted_.push_back({item.item, base, static_cast<uint32_t>(children.size()), 0});
            uint32_t offsets[kWidth] = {};
            for (uint32_t k = 0; k < children.size(); ++k)
                if (!plans_[children[k]].leaf) {
                    offsets[k] = emitted_.back().innerChildren++;
                    bvh_.records.resize(bvh_.records.size() + kItem);
                }
            for (uint32_t k = static_cast<uint32_t>(children.size()); k-- > 0;)
                if (!plans_[children[k]].leaf)
                    open.push_back({children[k], base + offsets[k], item.depth + 1});
            for (uint32_t k = 0; k < children.size(); ++k)
                if (plans_[children[k]].leaf) {
                    offsets[k] = items() - base;
                    writeLeaf(children[k]);
                }
            writeNode(item.item, base, children, offsets);
        }
        bvh_.nodes = static_cast<uint32_t>(emitted_.size());
        bvh_.stackNeed = stackNeed();
        return std::move(bvh_);
    }

private:
    struct Item {
        uint32_t node; // of the binary tree
        uint32_t item; // where it goes
        uint32_t depth;
    };
    struct Emitted {
        uint32_t item, base, children, innerChildren;
    };

    uint32_t items() const { return static_cast<uint32_t>(bvh_.records.size() / kItem); }

    // The binary nodes that become the children of a node; the root alone may be a leaf, its own only child.
    std::vector<uint32_t> childrenOf(uint32_t node) const {
        std::vector<uint32_t> children;
        if (plans_[node].leaf)
            children.push_back(node);
        else
            collect(node, kWidth, children);
        return children;
    }

    void collect(uint32_t node, uint32_t roots, std::vector<uint32_t>& children) const {
        const Plan& plan = plans_[node];
        while (roots > 1 && roots < kWidth && plan.leftRoots[roots] == 0) --roots;
        if (roots == 1 || tree_[node].isLeaf()) {
            children.push_back(node);
            return;
        }
        collect(node + 1, plan.leftRoots[roots], children);
        collect(tree_[node].right, roots - plan.leftRoots[roots], children);
    }

    void writeLeaf(uint32_t node) {
        std::vector<uint32_t> triangles;
        for (uint32_t i = node; triangles.size() < plans_[node].triangles; ++i)
            if (tree_[i].isLeaf()) triangles.push_back(tree_[i].primitive);
        std::sort(triangles.begin(), triangles.end());
        triangles.erase(std::unique(triangles.begin(), triangles.end()),
                        triangles.end()); // parts of a split one
        for (uint32_t primitive : triangles) {
            const uint32_t more = primitive != triangles.back() ? gpu::kMoreTriangles : 0u;
            writeTriangle(primitive, gpu::kTriangleItem | more);
        }
    }

    void writeTriangle(uint32_t primitive, uint32_t flags) {
        const glm::uvec3 v = scene_.triangles[primitive].vertex;
        const glm::vec3 p0 = scene_.vertices[v.x].position;
        const glm::vec3 e1 = scene_.vertices[v.y].position - p0;
        const glm::vec3 e2 = scene_.vertices[v.z].position - p0;
        const float margin = 8 * 0x1p-24f * std::max(glm::length(e1), glm::length(e2));
        bvh_.records.emplace_back(bitsOf(p0), primitive | flags);
        bvh_.records.emplace_back(bitsOf(e1), std::bit_cast<uint32_t>(e2.x));
        bvh_.records.emplace_back(std::bit_cast<uint32_t>(e2.y), std::bit_cast<uint32_t>(e2.z),
                                  std::bit_cast<uint32_t>(margin), 0u);
        ++bvh_.references;
    }

    void writeNode(uint32_t item, uint32_t base, const std::vector<uint32_t>& children,
                   const uint32_t* offsets) {
        glm::vec3 origin{0.0f};
        uint32_t exponents = 0;
        uint32_t lower[3] = {};
        uint32_t upper[3] = {};
        for (int axis = 0; axis < 3; ++axis) {
            float low = tree_[children[0]].bounds.lower[axis];
            float high = tree_[children[0]].bounds.upper[axis];
            for (uint32_t child : children) {
                low = std::min(low, tree_[child].bounds.lower[axis]);
                high = std::max(high, tree_[child].bounds.upper[axis]);
            }
            origin[axis] = std::max(low - padding_, -3.0e38f);
            const double start = origin[axis];
            int e = std::max(std::ilogb((double(high) + padding_ - start) / 255.0), -100);
            while (std::ceil(std::ldexp(double(high) + padding_ - start, -e)) > 255.0) ++e;
            exponents |= static_cast<uint32_t>(e + 127) << (8 * axis);
            for (uint32_t k = 0; k < kWidth; ++k) {
                double qLow = 255.0;
                double qHigh = 0.0;
                if (k < children.size()) {
                    const Bounds& b = tree_[children[k]].bounds;
                    qLow =
                        std::max(0.0, std::floor(std::ldexp(double(b.lower[axis]) - padding_ - start, -e)));
                    qHigh = std::ceil(std::ldexp(double(b.upper[axis]) + padding_ - start, -e));
                }
                lower[axis] |= static_cast<uint32_t>(qLow) << (8 * k);
                upper[axis] |= static_cast<uint32_t>(qHigh) << (8 * k);
            }
        }
        uint32_t packed = 0;
        for (uint32_t k = 0; k < children.size(); ++k) packed |= (gpu::kChildPresent | offsets[k]) << (4 * k);
        glm::uvec4* records = &bvh_.records[size_t{item} * kItem];
        records[0] = glm::uvec4(bitsOf(origin), exponents);
        records[1] = glm::uvec4(lower[0], lower[1], lower[2], upper[0]);
        records[2] = glm::uvec4(upper[1], upper[2], base << gpu::kGroupBits, packed);
    }

    // The most groups a traversal can hold: one for each level on which there are other children to visit.
    uint32_t stackNeed() const {
        std::vector<uint32_t> need(bvh_.records.size() / kItem, 0);
        for (auto node = emitted_.rbegin(); node != emitted_.rend(); ++node) {
            uint32_t below = 0;
            for (uint32_t k = 0; k < node->innerChildren; ++k) below = std::max(below, need[node->base + k]);
            need[node->item] = below + (node->children > 1 ? 1u : 0u);
        }
        return need[0];
    }

    const Scene& scene_;
    const BinaryTree& tree_;
    const std::vector<Plan>& plans_;
    // Boxes grow by a few roundings of the largest coordinate: the kernels' box test computes in floats
    // relative to the ray's origin.
    float padding_;
    std::vector<Emitted> emitted_;
    Bvh bvh_;
};

Bvh emptyBvh() {
    Bvh bvh;
    bvh.records = {glm::uvec4(0u, 0u, 0u, gpu::kTriangleItem), glm::uvec4(0u), glm::uvec4(0u)};
    return bvh;
}

bool fits(const Bvh& bvh) {
    return bvh.records.size() * sizeof(glm::uvec4) <= kBindingLimit;
}

} // namespace

Bvh buildBvh(const Scene& scene, const BvhOptions& options) {
    if (scene.triangles.empty()) return emptyBvh();
    // An item a triangle is the least there can be: refuse before building.
    const uint64_t leastBytes = uint64_t{scene.triangles.size()} * kItem * sizeof(glm::uvec4);
    if (leastBytes > kBindingLimit)
        fail(ExitCode::BadData, "{}: {} triangles need more than the 128 MiB a device can bind", scene.name,
             scene.triangles.size());

    Bvh bvh;
    const auto build = [&](const BinaryTree& tree, bool balanced) {
        bvh = Encoder(scene, tree, planCollapse(tree, balanced)).encode();
        bvh.bounds = tree[0].bounds;
    };
    BinaryTree tree;
    if (!options.median) tree = buildSahTree(scene, options.threads, options.splitReferences);
    if (!tree.empty()) build(tree, false);
    if (!tree.empty() && !fits(bvh) && options.splitReferences > 0.0f)
        return buildBvh(scene, {.threads = options.threads, .splitReferences = 0.0f});
    if (tree.empty() || bvh.stackNeed >= gpu::kTraversalStack) build(buildMedianTree(scene), true);
    if (!fits(bvh))
        fail(ExitCode::BadData, "{}: the tree over {} triangles takes {} MiB, a device can bind 128 MiB",
             scene.name, scene.triangles.size(), bvh.records.size() * sizeof(glm::uvec4) >> 20);
    return bvh;
}

} // namespace irradia
