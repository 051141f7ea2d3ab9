// The cache behind and within what light passes through: clear sheets and smooth glass are no vertices to ask
// or to learn at, and what they leave of the light is in the picture and in the targets alike. A cache that
// knows judges it, in the closed Lambert sphere of albedo 1/2 and emission 1/2 of cache_contract_test: what
// is seen is 1, glass or no glass.
#include "engine/scene/lights/area_table.h"
#include "tests/reference/glass_scenes.h"
#include "tests/reference/simple_scenes.h"
#include "tests/support/gpu_render.h"
#include "tests/support/oracle_cache.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using namespace irradia::test;

namespace {

const Camera kCamera = reference::lookAt({0.1f, 0.2f, 0.0f}, {0.0f, 0.0f, 1.0f}, 1.2f);

Device& device() {
    return deviceWith(QuadAccess::Texel);
}

Scene sphereOf(const glm::vec3& albedo, const glm::vec3& emission) {
    Scene scene;
    reference::addSphereFromInside(scene, reference::addMaterial(scene, reference::lambert(albedo, emission)),
                                   glm::vec3(0.0f), 1.0f, 16);
    return scene;
}

// Before the camera a clear sheet, and behind it a ball of smooth glass.
Scene glassFurnace() {
    Scene scene = sphereOf(glm::vec3(0.5f), glm::vec3(0.5f));
    reference::addQuad(scene, reference::addMaterial(scene, reference::glassSheet(0.0f)),
                       {-0.9f, -0.9f, 0.25f}, {1.8f, 0, 0}, {0, 1.8f, 0});
    reference::addCuboid(scene, reference::addMaterial(scene, reference::solidGlass(1.5f, 0.0f)),
                         {-0.15f, -0.15f, 0.35f}, {0.15f, 0.15f, 0.6f});
    return scene;
}

GpuScene upload(const Scene& scene) {
    PackedScene packed = packScene(scene);
    packAreaTable(packed);
    return uploadScene(device(), packed, buildBvh(scene));
}

double mean(const std::vector<glm::vec3>& values) {
    double sum = 0.0;
    for (const glm::vec3& v : values) sum += (double(v.x) + v.y + v.z) / 3.0;
    return sum / double(values.size());
}

// Of the first recorded vertex of every training path.
double meanFirstTarget(const OracleRenderer& oracle) {
    double sum = 0.0, count = 0.0;
    for (const reference::TrainingPath& path : oracle.trainingPaths())
        if (!path.vertices.empty()) sum += reference::luminance(path.vertices.front().gathered), count += 1.0;
    REQUIRE(count > 10000.0);
    return sum / count;
}

} // namespace

TEST_CASE("nothing of the cache is seen in clear glass, wherever paths end") {
    const Scene scene = glassFurnace();
    const GpuScene gpu = upload(scene);
    struct Case {
        float spread;
        uint32_t endDepth;
    };
    for (const Case& c : {Case{-1.0f, gpu::kNoDepth}, Case{0.01f, gpu::kNoDepth}, Case{1.0f, gpu::kNoDepth},
                          Case{10.0f, 0}, Case{10.0f, 1}, Case{10.0f, 3}}) {
        INFO("c = " << c.spread << ", end depth " << c.endDepth);
        NrcOptions options = oracleOptions(picture(192, 24), 0.5f);
        options.config.spread = c.spread;
        if (c.endDepth != gpu::kNoDepth) options.config.endDepth = c.endDepth;
        OracleRenderer oracle(device(), gpu, sceneBounds(scene), options);
        // 2.2e5 paths, each off by less than 0.7: sigma 1.5e-3 at most.
        CHECK(std::abs(mean(oracle.render(kCamera, 6).mean) - 1.0) < 0.005);
    }
    // An oracle a tenth too bright, asked at the first vertex that is one, shifts all by as much: glass is in
    // its way as it is in the light's. Were glass asked, it would show the oracle's 1/2 alone.
    NrcOptions options = oracleOptions(picture(192, 24), 0.55f);
    options.config.endDepth = 0;
    OracleRenderer oracle(device(), gpu, sceneBounds(scene), options);
    CHECK(std::abs(mean(oracle.render(kCamera, 6).mean) - 1.05) < 0.005);
}

TEST_CASE("targets of paths through glass are what the furnace scatters") {
    const Scene scene = glassFurnace();
    const GpuScene gpu = upload(scene);
    for (const float unbiasedShare : {0.0f, 1.0f}) {
        INFO("unbiased share " << unbiasedShare);
        NrcOptions options = oracleOptions(picture(192, 24), 0.5f, 128 * 128);
        options.config.spread = options.config.trainingSpread = 0.01f;
        options.config.unbiasedShare = unbiasedShare;
        OracleRenderer oracle(device(), gpu, sceneBounds(scene), options);
        oracle.render(kCamera, 1);
        // 1.6e4 targets, each off by less than 0.5.
        CHECK(std::abs(meanFirstTarget(oracle) - 0.5) < 0.015);
    }
}

TEST_CASE("targets hold of a lamp's light what a screen lets through") {
    // A point in a small ball that lets half of the light through: 1/8 of direct light where 1/4 would be,
    // and what the oracle, or further bounces, add.
    Scene scene = sphereOf(glm::vec3(0.5f), glm::vec3(0.0f));
    double area = 0.0;
    for (const Triangle& t : scene.triangles) {
        const glm::vec3 a = scene.vertices[t.vertex.x].position, b = scene.vertices[t.vertex.y].position;
        area += 0.5 * glm::length(glm::cross(b - a, scene.vertices[t.vertex.z].position - a));
    }
    PunctualLight point;
    point.intensity = glm::vec3(static_cast<float>(0.125 * area));
    scene.lights = {point};
    Material screen = reference::lambert(glm::vec3(0.0f));
    screen.alphaMode = AlphaMode::Blend;
    screen.alpha = 0.5f;
    reference::addSphere(scene, reference::addMaterial(scene, screen), glm::vec3(0.0f), 0.03f, 8, false);
    const GpuScene gpu = upload(scene);
    for (const float unbiasedShare : {0.0f, 1.0f}) {
        INFO("unbiased share " << unbiasedShare);
        NrcOptions options = oracleOptions(picture(192, 24), 0.5f, 32768);
        options.config.endDepth = 0;
        options.config.trainingSpread = -1.0f;
        options.config.unbiasedShare = unbiasedShare;
        OracleRenderer oracle(device(), gpu, sceneBounds(scene), options);
        oracle.render(kCamera, 1);
        const double expected = unbiasedShare > 0.0f ? 0.25 : 0.125 + 0.25;
        CHECK(std::abs(meanFirstTarget(oracle) - expected) < 0.02 * expected + 0.003);
    }
}
