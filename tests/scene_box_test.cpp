// Where a scene begins and how far it reaches: neither goes by strays.
#include "engine/scene/load_scene.h"
#include "engine/scene/scene_box.h"
#include "engine/scene/scene_origin.h"
#include "tests/gltf_builder.h"
#include "tests/support/triangle_scenes.h"
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <filesystem>

using namespace irradia;
using namespace irradia::test;

namespace {

void append(Scene& scene, const Scene& part) {
    for (uint32_t i = 0; i < part.triangles.size(); ++i) add(scene, corners(part, i));
}

bool areSame(const Bounds& a, const Bounds& b) {
    return a.lower == b.lower && a.upper == b.upper;
}

bool isWhole(const Scene& scene) {
    return areSame(sceneBox(scene), sceneBounds(scene));
}

// A room of 5 with furniture, or what stands for it.
Scene room(glm::vec3 centre = {}) {
    Scene scene = closedSphere(8, 12, 2.5f, centre);
    append(scene, triangleSoup(500, 0.2f, 3, 1.0f, centre));
    return scene;
}

// 200 long and 20 high, of few triangles.
Scene stadium() {
    Scene scene;
    const glm::vec3 p[4] = {{-100, 0, -70}, {100, 0, -70}, {100, 0, 70}, {-100, 0, 70}};
    const glm::vec3 up(0, 20, 0);
    add(scene, {p[0], p[2], p[1]});
    add(scene, {p[0], p[3], p[2]});
    for (int k = 0; k < 4; ++k) {
        add(scene, {p[k], p[(k + 1) % 4], p[(k + 1) % 4] + up});
        add(scene, {p[k], p[(k + 1) % 4] + up, p[k] + up});
    }
    return scene;
}

std::vector<glm::dvec3> pointsOf(const Scene& scene, const glm::dvec3& at, double scale = 1.0) {
    std::vector<glm::dvec3> points;
    for (const Vertex& v : scene.vertices) points.push_back(at + scale * glm::dvec3(v.position));
    return points;
}

} // namespace

TEST_CASE("a stray does not belong to the box, at any scale") {
    for (const float scale : {1e-4f, 1.0f, 1e6f}) {
        Scene scene = triangleSoup(300, 0.5f, 5, scale);
        const Bounds box = sceneBounds(scene);
        CHECK(areSame(sceneBox(scene), box));
        append(scene, closedSphere(6, 8, 0.05f * scale, scale * glm::vec3(1e4f, -300, 20)));
        const glm::vec3 below(0, -1e5f, 0);
        add(scene, {scale * below, scale * (below + glm::vec3(0.1f, 0, 0)),
                    scale * (below + glm::vec3(0, 0, 0.1f))});
        CHECK(areSame(sceneBox(scene), box));
    }
}

TEST_CASE("what sticks out is cut where the box may reach") {
    Scene scene = room();
    add(scene, {glm::vec3(0), glm::vec3(1e5f, 0, 0), glm::vec3(1e5f, 1e-5f, 0)}); // a thread of 100 km
    const Bounds box = sceneBox(scene);
    CHECK(box.upper.x > 2.5f);
    CHECK(box.upper.x < 50.0f);
    CHECK(box.lower.x == sceneBounds(room()).lower.x);
}

TEST_CASE("a stadium about a teapot is no stray, and neither is a second room as large") {
    Scene scene = stadium();
    append(scene, closedSphere(64, 96, 0.15f, {30, 1, -20}));
    REQUIRE(scene.triangles.size() > 100 * stadium().triangles.size());
    CHECK(isWhole(scene));
    Scene twins = room();
    append(twins, room({1e4f, 0, 0}));
    CHECK(isWhole(twins));
    // The same teapot outside, 10 km off, is one.
    Scene outside = stadium();
    append(outside, closedSphere(64, 96, 0.15f, {1e4f, 1, -20}));
    CHECK(areSame(sceneBox(outside), sceneBounds(stadium())));
}

TEST_CASE("ordinary scenes keep their bounds, and stand where they stood") {
    CHECK(isWhole(Scene{}));
    CHECK(isWhole(room()));
    CHECK(isWhole(triangleSoup(1, 1.0f, 7)));
    // The project's own, and those that IRRADIA_SCENES names, of other makers.
    std::vector<std::filesystem::path> folders{IRRADIA_BIN_DIR "/../scenes"};
    if (const char* more = std::getenv("IRRADIA_SCENES")) folders.emplace_back(more);
    for (const auto& folder : folders)
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() != ".glb") continue;
            INFO(entry.path());
            const Scene scene = loadScene(entry.path());
            CHECK(isWhole(scene));
            CHECK(scene.origin == glm::dvec3(0.0));
        }
}

TEST_CASE("the origin is about the median, near the bulk of the vertices whatever strays there are") {
    const Scene scene = room();
    CHECK(sceneOrigin({}) == glm::dvec3(0.0));
    CHECK(sceneOrigin({glm::dvec3(1, 2, 3)}) == glm::dvec3(1, 2, 3));
    CHECK(sceneOrigin(pointsOf(scene, {0, 1, 12})) == glm::dvec3(0.0));
    const glm::dvec3 at(1e6, -2e6, 3.3e5);
    for (const double scale : {1e-4, 1.0, 1e3}) {
        auto points = pointsOf(scene, at, scale);
        points.resize(points.size() + points.size() / 3, at + glm::dvec3(1e5, 1e5, -1e5));
        const glm::dvec3 off = glm::abs(sceneOrigin(points) - at);
        CHECK(std::max({off.x, off.y, off.z}) < 2.5 * scale);
    }
}

TEST_CASE("a node 1,000 km off loses no digit of its vertices") {
    GltfBuilder file;
    const int positions = file.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0.125}, {1.001f, 1, 0.3f}});
    const int node =
        file.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", file.indices({0, 1, 2, 1, 3, 2})}});
    file.json["nodes"][node]["translation"] = {1e6, -1e6, 2e6};
    const TempFolder folder;
    const Scene scene = loadScene(folder.write("far.glb", file.glb()));
    // The edges as the file has them, but for the rounding of coordinates of about 1.
    const Corners c = corners(scene, 1);
    CHECK(glm::length(glm::dvec3(c[1] - c[0]) - glm::dvec3(double(1.001f) - 1.0, 1, double(0.3f))) < 2e-7);
    CHECK(glm::length(glm::dvec3(c[0]) + scene.origin - glm::dvec3(1e6 + 1.0, -1e6, 2e6)) < 2e-7);
}
