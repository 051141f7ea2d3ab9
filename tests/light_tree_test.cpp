// The hierarchy of lights: what it bounds, how deep it gets, and that no light that reaches a point is out of
// its reach.
#include "engine/scene/lights/light_tree.h"
#include "tests/reference/random.h"
#include "tests/support/light_chances.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numeric>

using namespace irradia;
using reference::kPi;
using reference::Random;
using reference::Vec3;

namespace {

Vec3 anyDirection(Random& random) {
    return reference::direction(2.0 * random.uniform() - 1.0, 2.0 * kPi * random.uniform());
}

TreeLight lightAt(const Vec3& position, double size, Random& random) {
    TreeLight light;
    light.corners[0] = position;
    light.corners[1] = position + size * anyDirection(random);
    light.corners[2] = position + size * anyDirection(random);
    light.power = random.uniform();
    return light;
}

std::vector<TreeLight> anyLights(size_t count) {
    Random random(31);
    std::vector<TreeLight> lights;
    while (lights.size() < count) {
        const Vec3 position = 10.0 * random.uniform() * anyDirection(random);
        lights.push_back(lightAt(position, std::pow(10.0, -3.0 * random.uniform()), random));
        lights.back().isTwoSided = lights.size() % 7 == 0;
        if (lights.size() % 11 == 0) lights.back().power = 0.0;
    }
    return lights;
}

// Lights without extent: points, and spots of any angles.
std::vector<TreeLight> anyLamps(size_t count) {
    Random random(34);
    std::vector<TreeLight> lamps;
    while (lamps.size() < count) {
        const Vec3 at = 10.0 * random.uniform() * anyDirection(random);
        lamps.push_back({{at, at, at}, 0.1 + random.uniform(), false});
        const double outer = 0.5 * kPi * random.uniform(), inner = outer * random.uniform();
        lamps.back().cone = lamps.size() % 3 == 0 ? EmissionCone{{0, 0, 1}, kPi}
                                                  : EmissionCone{anyDirection(random), inner, outer - inner};
    }
    return lamps;
}

std::vector<TreeLight> mixedLights(size_t ofEach) {
    std::vector<TreeLight> lights = anyLights(ofEach);
    const std::vector<TreeLight> lamps = anyLamps(ofEach);
    lights.insert(lights.end(), lamps.begin(), lamps.end());
    return lights;
}

// Whether a light without extent, or a triangle's front or shining back, sends light to a point.
bool sendsTo(const TreeLight& light, const Vec3& point) {
    const Vec3 to = glm::normalize(point - light.corners[0]);
    if (!light.cone)
        return light.isTwoSided ||
               glm::dot(glm::cross(light.corners[1] - light.corners[0], light.corners[2] - light.corners[0]),
                        to) > 0.0;
    return std::acos(std::clamp(glm::dot(light.cone->axis, to), -1.0, 1.0)) <
           light.cone->spread + light.cone->reach;
}

// A closed sphere of radius 1 around the origin that shines outwards; rings x 2 rings x 2 triangles less
// those at the poles.
std::vector<TreeLight> shiningSphere(int rings) {
    std::vector<TreeLight> lights;
    const auto point = [&](int ring, int column) {
        return reference::direction(std::cos(kPi * ring / rings), kPi * column / rings);
    };
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        TreeLight light{{a, b, c}, 0.5 * glm::length(glm::cross(b - a, c - a)), false};
        if (glm::dot(glm::cross(b - a, c - a), a) < 0.0) std::swap(light.corners[1], light.corners[2]);
        lights.push_back(light);
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < 2 * rings; ++j) {
            if (i > 0) add(point(i, j), point(i, j + 1), point(i + 1, j));
            if (i + 1 < rings) add(point(i, j + 1), point(i + 1, j + 1), point(i + 1, j));
        }
    return lights;
}

Vec3 normalOf(const TreeLight& light) {
    return glm::normalize(
        glm::cross(light.corners[1] - light.corners[0], light.corners[2] - light.corners[0]));
}

// Walks the tree to the light's leaf, and checks every node on the way.
void checkTrail(const LightTree& tree, const std::vector<TreeLight>& lights, uint32_t light) {
    uint32_t at = 0, depth = 0;
    while (true) {
        const LightTreeNode& node = tree.nodes[at];
        for (const Vec3& corner : lights[light].corners)
            REQUIRE(glm::distance(corner, node.center) <= node.radius + 1e-12);
        const EmissionCone& cone = node.cone;
        const EmissionCone own =
            lights[light].cone ? *lights[light].cone
                               : EmissionCone{normalOf(lights[light]), lights[light].isTwoSided ? kPi : 0.0};
        const double between = std::acos(std::clamp(glm::dot(cone.axis, own.axis), -1.0, 1.0));
        REQUIRE(std::min(between + own.spread, kPi) <= cone.spread + 1e-9);
        REQUIRE(own.reach <= cone.reach);
        if (node.isLeaf) break;
        REQUIRE(depth < kMaxLightTreeDepth);
        at = node.child + (tree.trails[light] >> depth & 1u);
        ++depth;
    }
    REQUIRE(tree.nodes[at].child == light);
    REQUIRE(uint64_t(tree.trails[light]) >> depth == 0u);
}

} // namespace

TEST_CASE("a hierarchy of lights has a leaf for each, bounds them and knows their power") {
    const std::vector<TreeLight> lights = mixedLights(1500);
    const LightTree tree = buildLightTree(lights);
    CHECK(tree.nodes.size() == 2 * lights.size() - 1);
    for (uint32_t i = 0; i < lights.size(); ++i) checkTrail(tree, lights, i);
    for (const LightTreeNode& node : tree.nodes) {
        if (node.isLeaf) {
            CHECK(node.power == lights[node.child].power);
            continue;
        }
        const double sum = tree.nodes[node.child].power + tree.nodes[node.child + 1].power;
        CHECK(std::abs(node.power - sum) <= 1e-12 * sum);
    }
    const std::vector<TreeLight> alone(lights.begin(), lights.begin() + 1);
    CHECK(buildLightTree(alone).nodes.size() == 1);
}

TEST_CASE("trails of lights that no plane parts well fit their bits") {
    Random random(32);
    std::vector<TreeLight> same(1000, lightAt(Vec3(1.0), 0.1, random)), nested;
    for (int i = 0; i < 900; ++i) // each plane would part one light from all others
        nested.push_back(lightAt(Vec3(std::pow(0.5, i), 0.0, 0.0), 1e-12, random));
    for (const std::vector<TreeLight>& lights : {same, nested}) {
        const LightTree tree = buildLightTree(lights);
        CHECK(tree.nodes.size() == 2 * lights.size() - 1);
        for (uint32_t i = 0; i < lights.size(); ++i) checkTrail(tree, lights, i);
    }
}

TEST_CASE("every light that shines on a point may be chosen there, and chances sum to one at most") {
    const std::vector<TreeLight> lights = mixedLights(250);
    const LightTree tree = buildLightTree(lights);
    Random random(33);
    int shining = 0, dark = 0;
    for (int k = 0; k < 1000; ++k) {
        const Vec3 point = 15.0 * random.uniform() * anyDirection(random);
        const Vec3 normal = anyDirection(random);
        const std::vector<double> chances = test::lightChances(tree, {point, normal});
        CHECK(std::accumulate(chances.begin(), chances.end(), 0.0) <= 1.0 + 1e-9);
        for (size_t i = 0; i < lights.size(); ++i) {
            const bool isAbove = glm::dot(normal, lights[i].corners[0] - point) > 0.0;
            const bool shines = lights[i].power > 0.0 && isAbove && sendsTo(lights[i], point);
            if (shines) REQUIRE(chances[i] > 0.0);
            (shines ? shining : dark) += 1;
        }
    }
    CHECK((shining > 100000 && dark > 100000));
}

TEST_CASE("of a sphere's triangles those that face the point are chosen") {
    const std::vector<TreeLight> sphere = shiningSphere(16);
    const LightTree tree = buildLightTree(sphere);
    // Spheres around parts of the lamp are wider than these, which counts the more the nearer it is.
    for (const auto& [distance, least] : {std::pair(1.5, 0.5), std::pair(4.0, 0.8), std::pair(100.0, 0.9)}) {
        const Vec3 point = distance * glm::normalize(Vec3(0.3, -0.5, 0.7));
        const std::vector<double> chances = test::lightChances(tree, {point, -glm::normalize(point)});
        double facing = 0.0, facingPower = 0.0, power = 0.0;
        for (size_t i = 0; i < sphere.size(); ++i) {
            const bool faces = glm::dot(normalOf(sphere[i]), point - sphere[i].corners[0]) > 0.0;
            if (faces) facing += chances[i];
            if (faces) facingPower += sphere[i].power;
            power += sphere[i].power;
        }
        INFO("distance " << distance << ": facing " << facing << ", by power " << facingPower / power);
        CHECK(facingPower / power < 0.51);
        CHECK(facing > least);
    }
}

TEST_CASE("near lamps are chosen before far ones of the same power") {
    std::vector<TreeLight> lamps;
    for (int i = 0; i < 16; ++i) { // a row along x that shines downwards
        const Vec3 corner(i, 1.0, 0.0);
        lamps.push_back({{corner, corner + Vec3(0.1, 0, 0), corner + Vec3(0, 0, 0.1)}, 1.0, false});
    }
    const std::vector<double> chances =
        test::lightChances(buildLightTree(lamps), {Vec3(3.0, 0.0, 0.0), Vec3(0, 1, 0)});
    CHECK(chances[3] > 0.4); // by power 1/16; by what arrives 0.6
    CHECK(chances[3] > 20.0 * chances[15]);
}

TEST_CASE("a spot is not chosen where it does not shine, and a patch as often as the point that it equals") {
    const auto lampAt = [](const Vec3& at, const EmissionCone& cone) {
        TreeLight lamp{{at, at, at}, 1.0, false};
        lamp.cone = cone;
        return lamp;
    };
    const Vec3 down(0, -1, 0), up(0, 1, 0);
    const std::vector<TreeLight> pair{lampAt({-1, 1, 0}, {down, kPi}), lampAt({1, 1, 0}, {down, 0.1, 0.4})};
    const LightTree tree = buildLightTree(pair);
    // On the floor, at an angle from the spot's axis.
    const auto spotAt = [&](double degrees) {
        const Vec3 point(1.0 - std::tan(degrees / 180.0 * kPi), 0.0, 0.0);
        return test::lightChances(tree, {point, up})[1];
    };
    CHECK(std::abs(spotAt(0.0) - 1.0 / (1.0 + std::pow(5.0, -1.5))) < 1e-3); // the point is sqrt(5) away
    CHECK(spotAt(28.0) > 0.3);
    CHECK(spotAt(29.0) == 0.0);

    // A small patch of area x radiance 1 straight above, and a point beside it.
    const double size = 1e-3;
    const Vec3 corner(-1, 1, 0);
    std::vector<TreeLight> equal{{{corner, corner + Vec3(size, 0, 0), corner + Vec3(0, 0, size)}, 1.0, false},
                                 lampAt({1, 1, 0}, {down, kPi})};
    const std::vector<double> chances = test::lightChances(buildLightTree(equal), {Vec3(0, -100, 0), up});
    CHECK(std::abs(chances[0] - 0.5) < 1e-3);
}
