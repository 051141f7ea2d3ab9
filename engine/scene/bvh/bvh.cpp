#include "engine/scene/bvh/bvh.h"
#include "engine/error.h"
#include "engine/scene/bvh/binary.h"
#include "engine/scene/bvh/collapse.h"
#include "engine/scene/transparency.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace irradia {
namespace {

constexpr uint64_t kBindingLimit = uint64_t{128} << 20; // bytes: maxStorageBufferRange of lavapipe
constexpr uint32_t kWidth = gpu::kBvhWidth;
constexpr uint32_t kItem = gpu::kItemQuads;

// (Not GLM's floatBitsToUint: its vector form breaks strict aliasing.)
glm::uvec3 bitsOf(const glm::vec3& v) {
    return std::bit_cast<glm::uvec3>(v);
}
uint32_t bitsOf(float v) {
    return std::bit_cast<uint32_t>(v);
}

float floatBelow(double v) {
    const auto nearest = static_cast<float>(std::max(v, -3.0e38));
    return double(nearest) <= v ? nearest : std::nextafter(nearest, -3.0e38f);
}

// The boxes of up to four children on one axis, quantised.
struct QuantisedAxis {
    float origin = 0;
    int exponent = 0; // plane = origin + q * 2^exponent
    uint32_t lower = 0;
    uint32_t upper = 0; // byte k = q of child k
};

// Boxes grow by 8 roundings of the node's extent first: what intersectBoxes may err by for a ray from nearby
// (from afar its errors are a share of the distance). Absent children become inverted boxes.
QuantisedAxis quantise(const std::vector<Bounds>& children, int axis) {
    float low = children[0].lower[axis];
    float high = children[0].upper[axis];
    for (const Bounds& b : children) {
        low = std::min(low, b.lower[axis]);
        high = std::max(high, b.upper[axis]);
    }
    const double padding = 0x1p-21 * (double(high) - low);
    QuantisedAxis out;
    out.origin = floatBelow(low - padding);
    const double extent = double(high) + padding - out.origin;
    // An exponent near the largest that will do; far from denormal steps.
    out.exponent = std::max(extent > 0.0 ? std::ilogb(extent / 255.0) : -100, -100);
    while (std::ceil(std::ldexp(extent, -out.exponent)) > 255.0) ++out.exponent;
    const double scale = std::ldexp(1.0, -out.exponent);
    for (uint32_t k = 0; k < kWidth; ++k) {
        double lower = 255.0;
        double upper = 0.0;
        if (k < children.size()) {
            lower =
                std::max(0.0, std::floor((double(children[k].lower[axis]) - padding - out.origin) * scale));
            upper = std::ceil((double(children[k].upper[axis]) + padding - out.origin) * scale);
        }
        out.lower |= static_cast<uint32_t>(lower) << (8 * k);
        out.upper |= static_cast<uint32_t>(upper) << (8 * k);
    }
    return out;
}

// Writes the collapsed tree as quads, depth first: a node's children, then the children of its first child.
class Encoder {
public:
    Encoder(const Scene& scene, const BinaryTree& tree, const Collapse& collapse)
        : scene_(scene)
        , tree_(tree)
        , collapse_(collapse) {}

    Bvh encode() {
        bvh_.quads.resize(kItem);
        std::vector<Open> open{{0, 0, 1}};
        while (!open.empty()) {
            const Open node = open.back();
            open.pop_back();
            const std::vector<uint32_t> children = collapse_.childrenOf(node.binary);
            const auto firstChild = static_cast<uint32_t>(bvh_.quads.size() / kItem);
            bvh_.quads.resize(bvh_.quads.size() + children.size() * kItem);
            writeNode(node.item, firstChild, children);
            for (auto k = static_cast<uint32_t>(children.size()); k-- > 0;) {
                if (tree_[children[k]].isLeaf())
                    writeTriangle(firstChild + k, tree_[children[k]].primitive);
                else
                    open.push_back({children[k], firstChild + k, node.level + 1});
            }
            bvh_.maxDepth = std::max(bvh_.maxDepth, node.level);
            ++bvh_.nodes;
        }
        // A group for each level on which there are other children to visit.
        bvh_.stackNeed = bvh_.maxDepth;
        bvh_.bounds = tree_[0].bounds;
        return std::move(bvh_);
    }

private:
    struct Open {
        uint32_t binary; // node of the binary tree
        uint32_t item;   // where it goes
        uint32_t level;
    };

    void writeNode(uint32_t item, uint32_t firstChild, const std::vector<uint32_t>& children) {
        std::vector<Bounds> boxes;
        for (uint32_t child : children) boxes.push_back(tree_[child].bounds);
        const QuantisedAxis x = quantise(boxes, 0);
        const QuantisedAxis y = quantise(boxes, 1);
        const QuantisedAxis z = quantise(boxes, 2);
        const auto biased = [](const QuantisedAxis& axis) {
            return static_cast<uint32_t>(axis.exponent + 127);
        };
        glm::uvec4* quads = &bvh_.quads[size_t{item} * kItem];
        quads[0] =
            glm::uvec4(bitsOf({x.origin, y.origin, z.origin}), biased(x) | biased(y) << 8 | biased(z) << 16);
        quads[1] = glm::uvec4(x.lower, y.lower, z.lower, x.upper);
        quads[2] = glm::uvec4(y.upper, z.upper, firstChild << gpu::kGroupBits, (1u << children.size()) - 1u);
    }

    void writeTriangle(uint32_t item, uint32_t primitive) {
        const glm::uvec3 v = scene_.triangles[primitive].vertex;
        const glm::vec3 p0 = scene_.vertices[v.x].position;
        const glm::vec3 e1 = scene_.vertices[v.y].position - p0;
        const glm::vec3 e2 = scene_.vertices[v.z].position - p0;
        const float margin = 8 * 0x1p-24f * std::max(glm::length(e1), glm::length(e2));
        glm::uvec4* quads = &bvh_.quads[size_t{item} * kItem];
        quads[0] = glm::uvec4(bitsOf(p0), primitive | gpu::kTriangleItem);
        quads[1] = glm::uvec4(bitsOf(e1), bitsOf(e2.x));
        quads[2] = glm::uvec4(bitsOf(e2.y), bitsOf(e2.z), bitsOf(margin),
                              mayLetThrough(scene_, scene_.triangles[primitive]) ? 1u : 0u);
        ++bvh_.references;
    }

    const Scene& scene_;
    const BinaryTree& tree_;
    const Collapse& collapse_;
    Bvh bvh_;
};

Bvh encode(const Scene& scene, const BinaryTree& tree, bool balanced) {
    const Collapse collapse(tree, balanced);
    return Encoder(scene, tree, collapse).encode();
}

Bvh emptyBvh() {
    Bvh bvh;
    bvh.quads = {glm::uvec4(0u, 0u, 0u, gpu::kTriangleItem), glm::uvec4(0u), glm::uvec4(0u)};
    return bvh;
}

bool fits(const Bvh& bvh) {
    return bvh.quads.size() * sizeof(glm::uvec4) <= kBindingLimit;
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
    BinaryTree tree;
    if (!options.median) tree = buildSahTree(scene, options.threads, options.splitReferences);
    if (!tree.empty()) bvh = encode(scene, tree, false);
    if (!fits(bvh) && options.splitReferences > 0.0f)
        return buildBvh(scene, {.threads = options.threads, .splitReferences = 0.0f});
    if (tree.empty() || bvh.stackNeed >= gpu::kTraversalStack)
        bvh = encode(scene, buildMedianTree(scene), true);
    if (!fits(bvh))
        fail(ExitCode::BadData, "{}: the tree over {} triangles takes {} MiB, a device can bind 128 MiB",
             scene.name, scene.triangles.size(), bvh.quads.size() * sizeof(glm::uvec4) >> 20);
    return bvh;
}

} // namespace irradia
