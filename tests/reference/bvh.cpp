#include "tests/reference/bvh.h"
#include <algorithm>
#include <array>
#include <numeric>

namespace irradia::reference {

namespace {

constexpr uint32_t kMaxLeaf = 8;
constexpr int kBins = 16;
constexpr int kMaxSplitDepth = 64; // below it lists are halved, at most 32 times: the stack cannot overflow
constexpr int kStackSize = kMaxSplitDepth + 32;

Box boxOf(const TriangleShape& t) {
    Box box;
    box.include(t.p0);
    box.include(t.p0 + t.e1);
    box.include(t.p0 + t.e2);
    return box;
}

Vec3 centre(const Box& box) {
    return 0.5 * (box.lower + box.upper);
}

// Reciprocal of a direction, finite so that no slab test meets 0 * infinity.
Vec3 reciprocal(const Vec3& d) {
    const auto one = [](double x) { return 1.0 / (std::abs(x) < 1e-300 ? std::copysign(1e-300, x) : x); };
    return {one(d.x), one(d.y), one(d.z)};
}

// Distance at which the ray enters the box, or a huge one. The exit is widened by 4 ulp (Ize 2013, "Robust
// BVH ray traversal").
double entry(const Box& box, const Ray& ray, const Vec3& inverse, double limit) {
    const Vec3 a = (box.lower - ray.origin) * inverse, b = (box.upper - ray.origin) * inverse;
    const Vec3 nearest = glm::min(a, b), farthest = glm::max(a, b);
    const double from = std::max(maxComponent(nearest), 0.0);
    const double to = std::min({farthest.x, farthest.y, farthest.z, limit}) * (1.0 + 0x1p-50);
    return from <= to ? from : 1e308;
}

bool intersect(const TriangleShape& t, const Ray& ray, double from, double limit, Hit& hit) {
    const Vec3 p = glm::cross(ray.direction, t.e2);
    const double determinant = glm::dot(t.e1, p);
    if (determinant == 0.0) return false;
    const double inverse = 1.0 / determinant;
    const Vec3 fromCorner = ray.origin - t.p0;
    const double u = glm::dot(fromCorner, p) * inverse;
    if (!(u >= 0.0 && u <= 1.0)) return false;
    const Vec3 q = glm::cross(fromCorner, t.e1);
    const double v = glm::dot(ray.direction, q) * inverse;
    if (!(v >= 0.0 && u + v <= 1.0)) return false;
    const double distance = glm::dot(t.e2, q) * inverse;
    if (!(distance > from && distance < limit)) return false;
    hit.distance = distance, hit.u = u, hit.v = v;
    return true;
}

struct Split {
    int axis = -1;
    int bin = 0; // the first of the right side
    double cost = 1e300;
};

int binOf(double position, double lower, double upper) {
    return std::clamp(static_cast<int>(kBins * (position - lower) / (upper - lower)), 0, kBins - 1);
}

// The cheapest plane between bins of centres: cost = sum of area times count over both sides.
Split bestSplit(const std::vector<Box>& boxes, const uint32_t* first, const uint32_t* last,
                const Box& centres) {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        const double lower = centres.lower[axis], upper = centres.upper[axis];
        if (!(upper > lower)) continue;
        std::array<Box, kBins> bins{};
        std::array<uint32_t, kBins> counts{};
        for (const uint32_t* i = first; i != last; ++i) {
            const int bin = binOf(centre(boxes[*i])[axis], lower, upper);
            bins[bin].include(boxes[*i]);
            ++counts[bin];
        }
        std::array<double, kBins> rightCost{};
        Box box;
        uint32_t count = 0;
        for (int bin = kBins - 1; bin > 0; --bin) {
            box.include(bins[bin]);
            rightCost[bin] = (count += counts[bin]) * box.halfArea();
        }
        box = Box(), count = 0;
        for (int bin = 1; bin < kBins; ++bin) {
            box.include(bins[bin - 1]);
            const double cost = (count += counts[bin - 1]) * box.halfArea() + rightCost[bin];
            if (cost < best.cost) best = {axis, bin, cost};
        }
    }
    return best;
}

} // namespace

Bvh::Bvh(std::vector<TriangleShape> triangles)
    : triangles_(std::move(triangles))
    , order_(triangles_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::vector<Box> boxes;
    for (const TriangleShape& t : triangles_) boxes.push_back(boxOf(t));
    if (!triangles_.empty()) {
        nodes_.emplace_back();
        build(0, 0, static_cast<uint32_t>(triangles_.size()), 0, boxes);
    }
    for (const uint32_t i : order_) ordered_.push_back(triangles_[i]);
}

void Bvh::build(uint32_t node, uint32_t first, uint32_t last, int depth, const std::vector<Box>& boxes) {
    Box box, centres;
    for (uint32_t i = first; i < last; ++i) {
        box.include(boxes[order_[i]]);
        centres.include(centre(boxes[order_[i]]));
    }
    nodes_[node] = {box, first, last - first};
    uint32_t* begin = order_.data() + first;
    uint32_t* end = order_.data() + last;
    if (last - first <= 1) return;
    const Split split = bestSplit(boxes, begin, end, centres);
    const double leafCost = (last - first) * box.halfArea(), visit = box.halfArea();
    if (last - first <= kMaxLeaf && split.cost + visit >= leafCost) return;
    uint32_t* middle = begin + (end - begin) / 2; // halves of the list
    if (split.axis >= 0 && depth < kMaxSplitDepth)
        middle = std::partition(begin, end, [&](uint32_t i) {
            return binOf(centre(boxes[i])[split.axis], centres.lower[split.axis], centres.upper[split.axis]) <
                   split.bin;
        });
    const auto left = static_cast<uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = left, nodes_[node].count = 0;
    const auto cut = static_cast<uint32_t>(middle - order_.data());
    build(left, first, cut, depth + 1, boxes);
    build(left + 1, cut, last, depth + 1, boxes);
}

template <bool kAny>
std::optional<Hit> Bvh::traverse(const Ray& ray, double from, double limit) const {
    if (nodes_.empty()) return std::nullopt;
    const Vec3 inverse = reciprocal(ray.direction);
    struct Pending {
        uint32_t node;
        double distance;
    };
    std::array<Pending, kStackSize> stack; // left unset: every entry is written before it is read
    int size = 0;
    std::optional<Hit> found;
    Hit hit;
    Pending current{0, entry(nodes_[0].box, ray, inverse, limit)};
    for (;;) {
        if (current.distance < limit) {
            const Node& node = nodes_[current.node];
            if (node.count == 0) {
                Pending a{node.first, entry(nodes_[node.first].box, ray, inverse, limit)};
                Pending b{node.first + 1, entry(nodes_[node.first + 1].box, ray, inverse, limit)};
                if (b.distance < a.distance) std::swap(a, b);
                if (b.distance < limit) stack[size++] = b;
                current = a;
                continue;
            }
            for (uint32_t i = node.first; i < node.first + node.count; ++i)
                if (intersect(ordered_[i], ray, from, limit, hit)) {
                    hit.triangle = order_[i];
                    limit = hit.distance;
                    found = hit;
                    if (kAny) return found;
                }
        }
        if (size == 0) return found;
        current = stack[--size];
    }
}

std::optional<Hit> Bvh::closest(const Ray& ray, double limit, double from) const {
    return traverse<false>(ray, from, limit);
}
bool Bvh::isOccluded(const Ray& ray, double limit) const {
    return traverse<true>(ray, 0.0, limit).has_value();
}

} // namespace irradia::reference
