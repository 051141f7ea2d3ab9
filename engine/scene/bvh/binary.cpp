#include "engine/scene/bvh/binary.h"
#include "engine/error.h"
#include "engine/scene/bvh/embree.h"
#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>

namespace irradia {
namespace {

constexpr unsigned kMaxDepth = 64; // of the binary tree

// What Embree's callbacks build. A node holds its children's boxes: they are known before the children are.
struct RawNode {
    RawNode* children[2] = {nullptr, nullptr};
    Bounds bounds[2]; // of the children; of a leaf: its own
    uint32_t primitive = 0;
};

Bounds boundsOf(const RTCBounds& b) {
    return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

void* createNode(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(RawNode), alignof(RawNode))) RawNode;
}

void setChildren(void* node, void** children, unsigned count, void*) {
    for (unsigned k = 0; k < count; ++k)
        static_cast<RawNode*>(node)->children[k] = static_cast<RawNode*>(children[k]);
}

void setBounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned k = 0; k < count; ++k) static_cast<RawNode*>(node)->bounds[k] = boundsOf(*bounds[k]);
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, size_t, void*) {
    auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(RawNode), alignof(RawNode))) RawNode;
    leaf->primitive = primitives->primID;
    leaf->bounds[0] = {{primitives->lower_x, primitives->lower_y, primitives->lower_z},
                       {primitives->upper_x, primitives->upper_y, primitives->upper_z}};
    return leaf;
}

struct Corners {
    glm::vec3 p[3];
};

Corners cornersOf(const Scene& scene, uint32_t triangle) {
    const glm::uvec3 v = scene.triangles[triangle].vertex;
    return {{scene.vertices[v.x].position, scene.vertices[v.y].position, scene.vertices[v.z].position}};
}

Bounds boundsOf(const Corners& c) {
    return {glm::min(glm::min(c.p[0], c.p[1]), c.p[2]), glm::max(glm::max(c.p[0], c.p[1]), c.p[2])};
}

constexpr float kInfinity = std::numeric_limits<float>::infinity();

void extend(Bounds& bounds, const glm::vec3& p) {
    bounds.lower = glm::min(bounds.lower, p);
    bounds.upper = glm::max(bounds.upper, p);
}

void store(const glm::vec3& lower, const glm::vec3& upper, RTCBounds& out) {
    out = {lower.x, lower.y, lower.z, 0.0f, upper.x, upper.y, upper.z, 0.0f};
}

// Boxes of the two parts of a triangle on either side of a plane, cut to the reference's own box. A crossing
// is widened by the rounding of its computation, so no part of the triangle is left out. (Embree asks for
// every bin a reference touches: half of the time of a build is spent here.)
void splitReference(const RTCBuildPrimitive* reference, unsigned axis, float position, RTCBounds* left,
                    RTCBounds* right, void* user) {
    const int a = static_cast<int>(axis);
    const Corners c = cornersOf(*static_cast<const Scene*>(user), reference->primID);
    const glm::vec3 rounding =
        0x1p-21f * glm::max(glm::max(glm::abs(c.p[0]), glm::abs(c.p[1])), glm::abs(c.p[2]));
    glm::vec3 lower[2] = {glm::vec3(kInfinity), glm::vec3(kInfinity)};
    glm::vec3 upper[2] = {glm::vec3(-kInfinity), glm::vec3(-kInfinity)};
    for (int k = 0; k < 3; ++k) {
        const glm::vec3& from = c.p[k];
        const glm::vec3& to = c.p[k == 2 ? 0 : k + 1];
        for (int side = from[a] > position; side <= (from[a] >= position); ++side) {
            lower[side] = glm::min(lower[side], from);
            upper[side] = glm::max(upper[side], from);
        }
        if (!(std::min(from[a], to[a]) < position && position < std::max(from[a], to[a]))) continue;
        const glm::vec3 crossing = from + (position - from[a]) / (to[a] - from[a]) * (to - from);
        for (int side = 0; side < 2; ++side) {
            lower[side] = glm::min(lower[side], crossing - rounding);
            upper[side] = glm::max(upper[side], crossing + rounding);
        }
    }
    const glm::vec3 wholeLower{reference->lower_x, reference->lower_y, reference->lower_z};
    const glm::vec3 wholeUpper{reference->upper_x, reference->upper_y, reference->upper_z};
    upper[0][a] = std::min(upper[0][a], position);
    lower[1][a] = std::max(lower[1][a], position);
    store(glm::max(lower[0], wholeLower), glm::min(upper[0], wholeUpper), *left);
    store(glm::max(lower[1], wholeLower), glm::min(upper[1], wholeUpper), *right);
}

void flatten(const RawNode& node, const Bounds& bounds, BinaryTree& tree) {
    const size_t index = tree.size();
    tree.push_back({bounds, 0, node.primitive});
    if (!node.children[0]) return;
    flatten(*node.children[0], node.bounds[0], tree);
    tree[index].right = static_cast<uint32_t>(tree.size());
    flatten(*node.children[1], node.bounds[1], tree);
}

std::vector<RTCBuildPrimitive> references(const Scene& scene, size_t capacity) {
    std::vector<RTCBuildPrimitive> out;
    out.reserve(capacity);
    for (uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const Bounds b = boundsOf(cornersOf(scene, i));
        out.push_back({b.lower.x, b.lower.y, b.lower.z, 0, b.upper.x, b.upper.y, b.upper.z, i});
    }
    out.resize(capacity);
    return out;
}

using DevicePtr = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;
using BvhPtr = std::unique_ptr<RTCBVHTy, decltype(&rtcReleaseBVH)>;

} // namespace

BinaryTree buildSahTree(const Scene& scene, uint32_t threads, float splitReferences) {
    const size_t count = scene.triangles.size();
    const auto capacity = count + static_cast<size_t>(splitReferences * static_cast<float>(count));
    std::vector<RTCBuildPrimitive> primitives = references(scene, capacity);

    const DevicePtr device(rtcNewDevice(fmt::format("threads={}", threads).c_str()), rtcReleaseDevice);
    if (!device) fail(ExitCode::Internal, "embree: no device, error {}", int(rtcGetDeviceError(nullptr)));
    const BvhPtr bvh(rtcNewBVH(device.get()), rtcReleaseBVH);

    RTCBuildArguments build = rtcDefaultBuildArguments();
    build.buildQuality = RTC_BUILD_QUALITY_HIGH;
    build.maxBranchingFactor = 2;
    build.maxDepth = kMaxDepth;
    build.maxLeafSize = 1;
    build.bvh = bvh.get();
    build.primitives = primitives.data();
    build.primitiveCount = count;
    build.primitiveArrayCapacity = capacity;
    build.createNode = createNode;
    build.setNodeChildren = setChildren;
    build.setNodeBounds = setBounds;
    build.createLeaf = createLeaf;
    build.splitPrimitive = splitReference;
    build.userPtr = const_cast<Scene*>(&scene);
    auto* root = static_cast<RawNode*>(rtcBuildBVH(&build));

    BinaryTree tree;
    if (!root) return tree;
    Bounds bounds = root->bounds[0];
    if (root->children[0]) {
        extend(bounds, root->bounds[1].lower);
        extend(bounds, root->bounds[1].upper);
    }
    tree.reserve(2 * capacity);
    flatten(*root, bounds, tree);
    return tree;
}

namespace {

struct MedianBuilder {
    std::vector<Bounds> boxes;   // by triangle
    std::vector<uint32_t> order; // triangles, each node's contiguous
    BinaryTree tree;

    void build(size_t begin, size_t end) {
        const size_t index = tree.size();
        Bounds all{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
        for (size_t i = begin; i < end; ++i) {
            extend(all, boxes[order[i]].lower);
            extend(all, boxes[order[i]].upper);
        }
        tree.push_back({all, 0, order[begin]});
        if (end - begin == 1) return;
        const glm::vec3 size = all.upper - all.lower;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const size_t middle = begin + (end - begin) / 2;
        const auto at = [&](size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end), [&](uint32_t a, uint32_t b) {
            const float ca = 0.5f * boxes[a].lower[axis] + 0.5f * boxes[a].upper[axis];
            const float cb = 0.5f * boxes[b].lower[axis] + 0.5f * boxes[b].upper[axis];
            return ca < cb || (ca == cb && a < b);
        });
        build(begin, middle);
        tree[index].right = static_cast<uint32_t>(tree.size());
        build(middle, end);
    }
};

} // namespace

BinaryTree buildMedianTree(const Scene& scene) {
    MedianBuilder builder;
    builder.order.resize(scene.triangles.size());
    std::iota(builder.order.begin(), builder.order.end(), 0u);
    for (uint32_t i : builder.order) builder.boxes.push_back(boundsOf(cornersOf(scene, i)));
    if (!builder.order.empty()) builder.build(0, builder.order.size());
    return std::move(builder.tree);
}

} // namespace irradia
