// The hierarchy's structure, read back from its quads.
#include "engine/error.h"
#include "engine/scene/bvh/bvh.h"
#include "tests/support/triangle_scenes.h"
#include <algorithm>
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <set>

using namespace irradia;
using namespace irradia::test;

namespace {

struct Child {
    glm::dvec3 lower{0.0}, upper{0.0};
    uint32_t item = 0;
};

uint32_t itemsOf(const Bvh& bvh) {
    return static_cast<uint32_t>(bvh.quads.size() / gpu::kItemQuads);
}
const glm::uvec4* itemAt(const Bvh& bvh, uint32_t item) {
    return &bvh.quads.at(size_t{item} * 3);
}
bool isTriangle(const Bvh& bvh, uint32_t item) {
    return (itemAt(bvh, item)[0].w & gpu::kTriangleItem) != 0;
}

// Follows the layout in shaders/shared/bvh.h, in double precision.
std::vector<Child> childrenOf(const Bvh& bvh, uint32_t item) {
    const glm::uvec4* r = itemAt(bvh, item);
    const glm::vec3 origin = std::bit_cast<glm::vec3>(glm::uvec3(r[0]));
    const uint32_t lower[3] = {r[1].x, r[1].y, r[1].z};
    const uint32_t upper[3] = {r[1].w, r[2].x, r[2].y};
    std::vector<Child> children;
    for (uint32_t k = 0; k < 4; ++k) {
        if ((r[2].w >> k & 1u) == 0) continue;
        Child child;
        child.item = (r[2].z >> gpu::kGroupBits) + k;
        for (int axis = 0; axis < 3; ++axis) {
            const double step = std::ldexp(1.0, static_cast<int>(r[0].w >> (8 * axis) & 255u) - 127);
            child.lower[axis] = origin[axis] + step * (lower[axis] >> (8 * k) & 255u);
            child.upper[axis] = origin[axis] + step * (upper[axis] >> (8 * k) & 255u);
        }
        children.push_back(child);
    }
    return children;
}

uint32_t primitiveAt(const Bvh& bvh, uint32_t item) {
    return itemAt(bvh, item)[0].w & gpu::kPrimitiveMask;
}

struct Walk {
    std::vector<uint32_t> visits; // by item
    std::set<uint32_t> primitives;
    uint32_t nodes = 0;
    uint32_t references = 0;
    uint32_t depth = 0;
};

// Visits everything below a node; returns the groups a traversal can have on its stack there.
uint32_t walk(const Bvh& bvh, uint32_t item, uint32_t depth, Walk& out) {
    ++out.visits[item];
    ++out.nodes;
    out.depth = std::max(out.depth, depth);
    const std::vector<Child> children = childrenOf(bvh, item);
    REQUIRE(!children.empty());
    uint32_t below = 0;
    for (const Child& child : children) {
        if (!isTriangle(bvh, child.item)) {
            below = std::max(below, walk(bvh, child.item, depth + 1, out));
            continue;
        }
        ++out.visits[child.item];
        out.primitives.insert(primitiveAt(bvh, child.item));
        ++out.references;
    }
    return below + 1;
}

void checkStructure(const Scene& scene, const Bvh& bvh) {
    Walk seen;
    seen.visits.resize(itemsOf(bvh));
    const uint32_t need = walk(bvh, bvh.root, 1, seen);
    CHECK(std::count(seen.visits.begin(), seen.visits.end(), 1u) == itemsOf(bvh));
    CHECK(seen.primitives.size() == scene.triangles.size());
    CHECK(*seen.primitives.rbegin() == scene.triangles.size() - 1);
    CHECK(seen.nodes == bvh.nodes);
    CHECK(seen.references == bvh.references);
    CHECK(seen.depth == bvh.maxDepth);
    CHECK(need == bvh.stackNeed);
    CHECK(need < gpu::kTraversalStack); // entry 0 is the stack's bottom
}

bool holds(const Child& box, const glm::dvec3& p) {
    return glm::all(glm::lessThanEqual(box.lower, p)) && glm::all(glm::lessThanEqual(p, box.upper));
}

// Is the triangle in a leaf that is reached through boxes that all hold the point?
bool reaches(const Bvh& bvh, uint32_t item, const glm::dvec3& point, uint32_t primitive) {
    for (const Child& child : childrenOf(bvh, item)) {
        if (!holds(child, point)) continue;
        if (!isTriangle(bvh, child.item)) {
            if (reaches(bvh, child.item, point, primitive)) return true;
            continue;
        }
        if (primitiveAt(bvh, child.item) == primitive) return true;
    }
    return false;
}

// Every point of every triangle must be found through its boxes: corners, edges and points inside.
uint32_t pointsLost(const Scene& scene, const Bvh& bvh) {
    Random random(7);
    uint32_t lost = 0;
    for (uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const Corners c = corners(scene, i);
        for (uint32_t k = 0; k < 12; ++k) {
            double u = k < 3 ? k == 1 : random.uniform();
            double v = k < 3 ? k == 2 : random.uniform();
            if (k >= 3 && k < 6) v = k == 3 ? 0 : k == 4 ? 1 - u : v, u = k == 5 ? 0 : u;
            if (u + v > 1) u = 1 - u, v = 1 - v;
            const glm::dvec3 p0(c[0]);
            const glm::dvec3 point = p0 + u * (glm::dvec3(c[1]) - p0) + v * (glm::dvec3(c[2]) - p0);
            lost += reaches(bvh, bvh.root, point, i) ? 0 : 1;
        }
    }
    return lost;
}

void checkBvh(const Scene& scene, const BvhOptions& options = {}) {
    const Bvh bvh = buildBvh(scene, options);
    checkStructure(scene, bvh);
    CHECK(pointsLost(scene, bvh) == 0);
}

} // namespace

TEST_CASE("every triangle is reachable once and lies in its boxes") {
    checkBvh(triangleSoup(3000, 0.2f, 1), {.splitReferences = 0.0f});
    checkBvh(closedSphere(24, 40, 3.0f), {.splitReferences = 0.0f});
    const Bvh bvh = buildBvh(triangleSoup(3000, 0.2f, 1), {.splitReferences = 0.0f});
    CHECK(bvh.references == 3000);
}

TEST_CASE("with spatial splits every part of a triangle is reachable") {
    const Scene longOnes = triangleSoup(2000, 2.0f, 2);
    checkBvh(longOnes);
    CHECK(buildBvh(longOnes).references > 2000); // or nothing was split and the case tests nothing
    checkBvh(triangleSoup(2000, 0.5f, 3, 1000.0f, {5000, -20, 3}));
    checkBvh(closedSphere(24, 40, 3.0f, {100, 0, 0}));
}

TEST_CASE("the same scene gives the same quads at any number of threads") {
    const Scene scene = triangleSoup(8000, 0.3f, 4);
    const Bvh once = buildBvh(scene);
    for (uint32_t threads : {1u, 2u, 3u}) CHECK(buildBvh(scene, {.threads = threads}).quads == once.quads);
}

TEST_CASE("an empty scene has a root that nothing hits") {
    const Bvh bvh = buildBvh(Scene{});
    REQUIRE(bvh.quads.size() == gpu::kItemQuads);
    CHECK(isTriangle(bvh, bvh.root));
    CHECK(glm::uvec3(bvh.quads[1]) == glm::uvec3(0)); // no edges
    CHECK(bvh.stackNeed == 0);
}

TEST_CASE("few triangles, equal ones and points") {
    for (uint32_t count : {1u, 2u, 3u, 4u, 5u, 9u}) checkBvh(triangleSoup(count, 0.5f, count));
    Scene equal;
    for (int i = 0; i < 300; ++i) add(equal, {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)});
    checkBvh(equal);
    Scene points;
    for (int i = 0; i < 500; ++i) add(points, {glm::vec3(2), glm::vec3(2), glm::vec3(2)});
    checkBvh(points);
}

TEST_CASE("sizes from 1e-18 to 1e18 in one scene stay within the stack") {
    Scene chain;
    for (int i = -60; i <= 60; ++i) {
        const float s = std::ldexp(1.0f, i);
        add(chain, {glm::vec3(s, 0, 0), glm::vec3(2 * s, s, 0), glm::vec3(2 * s, 0, s)});
    }
    checkBvh(chain);
    // Deeper than the surface area heuristic may go: copies at every size.
    Scene deep;
    for (int i = -60; i <= 60; ++i)
        for (int k = 0; k < 20; ++k) add(deep, corners(chain, static_cast<uint32_t>(i + 60)));
    checkBvh(deep);
}

TEST_CASE("the fallback for trees too deep is sound, and shallow") {
    const Scene soup = triangleSoup(3000, 0.2f, 9);
    checkBvh(soup, {.median = true});
    CHECK(buildBvh(soup, {.median = true}).stackNeed <=
          7); // ceil(log2(3000)) = 12, two levels a node, and the leaf's
}

TEST_CASE("huge coordinates") {
    checkBvh(triangleSoup(500, 0.2f, 5, 1e30f));
    checkBvh(triangleSoup(500, 0.2f, 6, 1.0f, glm::vec3(1e7f)));
    checkBvh(triangleSoup(100, 1.0f, 8, 3e37f));
}

TEST_CASE("a scene too large for a binding is refused before anything is built") {
    Scene scene;
    scene.name = "crowd";
    add(scene, {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)});
    scene.triangles.resize(2'900'000, scene.triangles[0]);
    try {
        buildBvh(scene);
        FAIL("not refused");
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::BadData);
        CHECK(std::string(error.what()).find("2900000 triangles") != std::string::npos);
    }
}
