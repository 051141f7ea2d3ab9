// What paths ask the cache and tell it, judged with a cache that knows: in a closed Lambert sphere of albedo
// 1/2 and emission 1/2 scattered radiance is 1/2 everywhere, and what is seen is 1 wherever paths end. Gaps
// and double counts of light show here.
#include "engine/scene/lights/area_table.h"
#include "tests/reference/simple_scenes.h"
#include "tests/support/gpu_render.h"
#include "tests/support/oracle_cache.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr uint32_t kBounces = 14; // what they cut is less than 1e-4

Device& device() {
    return deviceWith(QuadAccess::Texel);
}

const Scene& sphere() {
    static const Scene* scene = [] {
        auto* made = new Scene;
        const uint32_t wall =
            reference::addMaterial(*made, reference::lambert(glm::vec3(0.5f), glm::vec3(0.5f)));
        reference::addSphereFromInside(*made, wall, glm::vec3(0.0f), 1.0f, 16);
        return made;
    }();
    return *scene;
}

const GpuScene& furnace() {
    static const GpuScene* scene = [] {
        PackedScene packed = packScene(sphere());
        packAreaTable(packed);
        return new GpuScene(uploadScene(device(), packed, buildBvh(sphere())));
    }();
    return *scene;
}

OracleRenderer withOracle(const NrcOptions& options) {
    return {device(), furnace(), sceneBounds(sphere()), options};
}

const Camera kCamera = reference::lookAt({0.1f, 0.2f, 0.0f}, {0.0f, 0.0f, 1.0f}, 1.2f);

double mean(const std::vector<glm::vec3>& values) {
    double sum = 0.0;
    for (const glm::vec3& v : values) sum += (double(v.x) + v.y + v.z) / 3.0;
    return sum / double(values.size());
}

// 2.6e5 paths, each off by less than 0.6: sigma of the mean is 1.2e-3 at most.
constexpr uint32_t kFrames = 4;
constexpr double kTolerance = 0.005;

} // namespace

TEST_CASE("an oracle gives the furnace's radiance whatever the spread at which paths end") {
    for (const float c : {-1.0f, 1e-4f, 1e-2f, 1.0f, 10.0f}) {
        NrcOptions options = oracleOptions(picture(256, kBounces), 0.5f);
        options.config.spread = c;
        INFO("c = " << c);
        CHECK(std::abs(mean(withOracle(options).render(kCamera, kFrames).mean) - 1.0) < kTolerance);
    }
}

TEST_CASE(
    "an oracle gives the furnace's radiance at every end depth, and one too bright what must come of it") {
    for (const uint32_t depth : {0u, 1u, 2u, 5u}) {
        INFO("paths end at vertex " << depth);
        // A tenth too much of what half ^ depth of all light passes through.
        const double tooMuch = 0.05 * std::pow(0.5, depth);
        for (const bool bright : {false, true}) {
            NrcOptions options = oracleOptions(picture(256, kBounces), bright ? 0.55f : 0.5f);
            options.config.endDepth = depth;
            const double seen = mean(withOracle(options).render(kCamera, kFrames).mean);
            CHECK(std::abs(seen - (bright ? 1.0 + tooMuch : 1.0)) < kTolerance);
            if (bright && depth <= 2) CHECK_FALSE(std::abs(seen - 1.0) < kTolerance);
        }
    }
}

TEST_CASE("targets are the furnace's scattered radiance at every vertex of training paths") {
    struct Case {
        float spread;
        float unbiasedShare;
    };
    constexpr float kNever = std::numeric_limits<float>::infinity();
    for (const Case& c : {Case{0.01f, 0.0f}, Case{0.01f, 1.0f}, Case{1.0f, 0.25f}, Case{kNever, 0.0f}}) {
        INFO("c = " << c.spread << ", unbiased share " << c.unbiasedShare);
        for (const bool bright : {false, true}) {
            NrcOptions options = oracleOptions(picture(256, kBounces), bright ? 0.6f : 0.5f, 128 * 128);
            options.config.spread = options.config.trainingSpread = c.spread;
            options.config.unbiasedShare = c.unbiasedShare;
            OracleRenderer oracle = withOracle(options);
            oracle.render(kCamera, 1);
            const std::vector<glm::vec3> targets = oracle.targets();
            REQUIRE(targets.size() > 16384);
            const double target = mean(targets);
            // 1.6e4 paths of some correlated vertices, each target off by less than 0.5: sigma below 0.004.
            if (!bright) CHECK(std::abs(target - 0.5) < 0.012);
            // Suffixes that end in the cache carry a fifth too much of it back; those that do not, nothing.
            if (bright && c.unbiasedShare < 1.0f && c.spread < kNever) CHECK(target > 0.512);
            if (bright && c.unbiasedShare == 1.0f) CHECK(std::abs(target - 0.5) < 0.012);
        }
    }
}

TEST_CASE("targets hold the light of a point once, whether paths end in the cache or not") {
    Scene scene;
    reference::addSphereFromInside(scene, reference::addMaterial(scene, reference::lambert(glm::vec3(0.5f))),
                                   glm::vec3(0.0f), 1.0f, 16);
    // All light of the point falls on the sphere of this area, which scatters it back onto itself until the
    // mean of what it scatters is the mean irradiance over pi, 1/2.
    PunctualLight point;
    double area = 0.0;
    for (const Triangle& t : scene.triangles) {
        const glm::vec3 a = scene.vertices[t.vertex.x].position, b = scene.vertices[t.vertex.y].position;
        area += 0.5 * glm::length(glm::cross(b - a, scene.vertices[t.vertex.z].position - a));
    }
    point.intensity = glm::vec3(static_cast<float>(0.125 * area));
    scene.lights = {point};
    PackedScene packed = packScene(scene);
    packAreaTable(packed);
    const GpuScene gpu = uploadScene(device(), packed, buildBvh(scene));
    for (const float unbiasedShare : {0.0f, 1.0f}) {
        NrcOptions options = oracleOptions(picture(192, kBounces), 0.5f, 32768, true);
        options.config.endDepth = 0;
        options.config.trainingSpread = -1.0f;
        options.config.unbiasedShare = unbiasedShare;
        OracleRenderer oracle(device(), gpu, sceneBounds(scene), options);
        CHECK(std::abs(mean(oracle.render(kCamera, 1).mean) - 0.5) < 0.02); // facets are not lit evenly
        double sum = 0.0, count = 0.0;
        for (const reference::TrainingPath& path : oracle.trainingPaths())
            if (!path.vertices.empty())
                sum += reference::luminance(path.vertices.front().gathered), count += 1.0;
        INFO("target " << sum / count);
        CHECK(count > 32000.0);
        CHECK(std::abs(sum / count - 0.5) < 0.01);
    }
}

TEST_CASE("targets of paths from the surfaces are the furnace's scattered radiance too") {
    struct Case {
        float spread;
        float unbiasedShare;
    };
    for (const Case& c : {Case{-1.0f, 0.0f}, Case{0.01f, 0.0625f}, Case{0.01f, 1.0f}, Case{30.0f, 0.25f}}) {
        INFO("c = " << c.spread << ", unbiased share " << c.unbiasedShare);
        for (const bool bright : {false, true}) {
            NrcOptions options = oracleOptions(picture(192, kBounces), bright ? 0.6f : 0.5f, 32768, true);
            options.config.endDepth = 0; // of what is seen
            options.config.trainingSpread = c.spread;
            options.config.unbiasedShare = c.unbiasedShare;
            OracleRenderer oracle = withOracle(options);
            oracle.render(kCamera, 1);
            const std::vector<reference::TrainingPath> paths = oracle.trainingPaths();
            // All start with a record, and go on with the one light sample and one bounce of their vertex.
            double sum = 0.0, longest = 0.0, ends = 0.0;
            for (size_t p = 1; p < paths.size(); ++p) {
                REQUIRE(!paths[p].vertices.empty());
                sum += reference::luminance(paths[p].vertices.front().gathered);
                longest = std::max(longest, double(paths[p].vertices.size()));
                ends += paths[p].end.has_value();
            }
            const double count = double(paths.size() - 1), target = sum / count;
            INFO("target " << target << ", " << ends / count << " end in the cache, " << longest);
            // 3.3e4 independent paths, each off by less than 0.5: sigma 2.8e-3 at most.
            if (!bright || c.unbiasedShare == 1.0f) CHECK(std::abs(target - 0.5) < 0.01);
            // A fifth too much of the half that one bounce brings back; less where suffixes are longer.
            if (bright && c.spread < 0.0f) CHECK(std::abs(target - 0.55) < 0.01);
            if (bright && c.unbiasedShare < 1.0f) CHECK(target > 0.51);
            if (c.spread < 0.0f) CHECK((longest == 1.0 && ends == count));
            if (c.unbiasedShare == 1.0f) CHECK((longest > 4.0 && ends < 0.01 * count));
        }
    }
}

TEST_CASE("one path of each tile trains, another in each frame") {
    constexpr uint32_t kTiles = 9 * 10; // neither side divides the picture's
    NrcOptions options = oracleOptions(picture(64, kBounces), 0.5f, kTiles);
    options.config.endDepth = 0;
    options.config.trainingSpread = -1.0f;
    OracleRenderer oracle = withOracle(options);
    CHECK(oracle.rule().tilesX == 9);
    oracle.render(kCamera, 1);
    const std::vector<glm::vec3> first = oracle.targets();
    CHECK(first.size() == kTiles); // the vertex that is asked; the one after it ends the suffix
    CHECK(oracle.queryWeights().size() == 64 * 64);
    oracle.render(kCamera, 2);
    CHECK(oracle.targets().size() == kTiles);
    CHECK(oracle.targets() != first);
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(device().validationMessages() == 0);
}
