// Which light comes to the picture through the cache, and where the cache has
// no place in it.
#include "tests/reference/simple_scenes.h"
#include "tests/support/cached_scene.h"
#include "tests/support/gpu_render.h"
#include "tests/support/oracle_cache.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using namespace irradia::test;

namespace {

Device& device() {
    return deviceWith(QuadAccess::Texel);
}

// ---- mirrors ----

// A metal of the given roughness in front of the camera, in which stripes
// behind the camera are seen under a constant sky.
constexpr float kStripe = 0.5f;   // width
constexpr double kMirrored = 3.5; // distance at which the camera sees the stripes
Scene stripesInMetal(float roughness) {
    Scene scene;
    Material metal;
    metal.baseColor = glm::vec3(0.95f);
    metal.roughness = roughness;
    const uint32_t mirror = reference::addMaterial(scene, metal);
    const uint32_t stripes[] = {reference::addMaterial(scene, reference::lambert(glm::vec3(0.1f))),
                                reference::addMaterial(scene, reference::lambert(glm::vec3(0.8f)))};
    reference::addQuad(scene, mirror, {-2, -2, -1}, {4, 0, 0}, {0, 4, 0});
    for (int i = 0; i < 8; ++i)
        reference::addQuad(scene, stripes[i % 2], {-2.0f + kStripe * float(i), -2, 1}, {0, 4, 0},
                           {kStripe, 0, 0});
    scene.environment.constant = glm::vec3(1.0f);
    scene.cameras.push_back(reference::lookAt({0.0f, 0.0f, 0.5f}, {0.0f, 0.0f, -1.0f}, 0.7f));
    return scene;
}

// (bright - dark) / (bright + dark) of the stripes, over pixels that see one
// alone.
double contrast(const FilmImage& film, float verticalFov) {
    double sums[2] = {}, counts[2] = {};
    const double pixel = 2.0 * std::tan(0.5 * double(verticalFov)) * kMirrored / film.width; // at the stripes
    for (int x = 0; x < film.width; ++x) {
        const double at = ((x + 0.5 - 0.5 * film.width) * pixel + 2.0) / double(kStripe);
        const double margin = std::min(at - std::floor(at), std::ceil(at) - at) * double(kStripe);
        if (margin < pixel) continue;
        const int stripe = static_cast<int>(at) % 2;
        for (int y = 0; y < film.height; ++y) {
            sums[stripe] += double(film.mean[size_t(y) * film.width + x].g);
            counts[stripe] += 1.0;
        }
    }
    const double dark = sums[0] / counts[0], bright = sums[1] / counts[1];
    return (bright - dark) / (bright + dark);
}

} // namespace

// The oracle's cache says the same radiance everywhere: where it is looked at,
// there are no stripes.
TEST_CASE("what a mirror shows is not the cache") {
    const PathTracerOptions options = picture(64, 6);
    constexpr uint32_t kFrames = 8;
    const Scene scene = stripesInMetal(0.0f);
    const Camera& camera = scene.cameras[0];
    const GpuScene gpu = uploaded(device(), scene);
    const double truth =
        contrast(GpuRenderer(device(), scene).render(camera, options, kFrames), camera.verticalFov);
    const auto contrastWith = [&](float spread, uint32_t endDepth) {
        NrcOptions asked = oracleOptions(options, 0.5f);
        asked.config.spread = spread;
        asked.config.endDepth = endDepth;
        OracleRenderer oracle(device(), gpu, sceneBounds(scene), asked);
        return contrast(oracle.render(camera, kFrames), camera.verticalFov) / truth;
    };
    CHECK(contrastWith(0.01f, gpu::kNoDepth) > 0.97);
    // Planted: paths that end at the vertex behind the mirror.
    CHECK(contrastWith(0.01f, 1) < 0.03);
}

// ---- outside of the box ----

namespace {

// The small box, its cache asked at each first vertex within `bounds` and as it
// is at the start.
FilmImage untrained(const NrcOptions& options, const Bounds& bounds) {
    const Scene scene = reference::smallBox();
    return CachedScene(device(), scene, options, bounds).view(scene.cameras[0]);
}

} // namespace

TEST_CASE("hits outside of the cache's box are path traced on") {
    const Scene scene = reference::smallBox();
    NrcOptions options;
    options.paths = picture(64, 0); // to the first vertex' direct light
    options.paths.layers = true;
    options.config = nrcPreset("fast");
    options.config.endDepth = 0;
    const FilmImage plain = GpuRenderer(device(), scene).render(scene.cameras[0], options.paths, 1);
    const Bounds whole = sceneBounds(scene);
    Bounds half = whole;
    half.upper.x = 0.1f;
    const FilmImage film = untrained(options, half), everywhere = untrained(options, whole);
    size_t outside = 0, inside = 0, wrongOutside = 0, cachedInside = 0, cachedOutside = 0;
    for (size_t i = 0; i < plain.mean.size(); ++i) {
        const float beyond = plain.position[i].x - half.upper.x;
        if (!std::isfinite(plain.depth[i]) || std::abs(beyond) < 1e-3f) continue;
        if (beyond < 0.0f) {
            ++inside;
            cachedInside += film.mean[i] != plain.mean[i];
        } else {
            ++outside;
            wrongOutside += film.mean[i] != plain.mean[i]; // bit for bit
            cachedOutside += everywhere.mean[i] != plain.mean[i];
        }
    }
    CHECK(inside > 1000);
    CHECK(outside > 1000);
    CHECK(wrongOutside == 0);
    CHECK(2 * cachedInside > inside);   // what lies in shadow is dark to both
    CHECK(2 * cachedOutside > outside); // planted: a box that holds all
}

TEST_CASE("nothing is asked or learned outside of the cache's box") {
    const Scene scene = reference::smallBox();
    NrcOptions options;
    options.paths = picture(48, 6);
    options.config = nrcPreset("fast");
    options.config.minRecords = 512;
    options.config.spread = -1.0f; // wherever it can be asked
    const FilmImage plain = GpuRenderer(device(), scene).render(scene.cameras[0], options.paths, 2);
    CachedScene elsewhere(device(), scene, options, Bounds{{5, 5, 5}, {6, 6, 6}});
    const std::vector<glm::vec3> seen = elsewhere.learn(scene.cameras[0], 2).mean;
    size_t others = 0;
    float largest = 0.0f;
    for (size_t i = 0; i < seen.size(); ++i) {
        others += seen[i] != plain.mean[i];
        largest = std::max(largest, glm::length(seen[i] - plain.mean[i]) / glm::length(plain.mean[i]));
    }
    INFO(others << " of " << seen.size() << " pixels differ, by " << largest << " at most");
    // A GPU's compiler may contract the two variants of a kernel differently; then few paths go another way.
    CHECK(others <= (device().isCpu() ? 0 : seen.size() / 50));
    CHECK(elsewhere.renderer().counts().records == 0);
    CHECK(elsewhere.renderer().counts().training.steps == 0);
    CachedScene there(device(), scene, options);
    CHECK(there.learn(scene.cameras[0], 2).mean != plain.mean);
    CHECK(there.renderer().counts().records > 256);
}

// ---- light of many bounces ----

namespace {

// Four chambers behind each other, each joined to the next by a gap now at the
// ceiling, now at the floor; the far wall of the last gives all light, the
// camera is in the first.
Scene chambers() {
    constexpr float kGap = 0.5f;
    Scene scene;
    const uint32_t wall = reference::addMaterial(scene, reference::lambert(glm::vec3(0.9f))),
                   lamp =
                       reference::addMaterial(scene, reference::lambert(glm::vec3(0.0f), glm::vec3(20.0f)));
    addRoom(scene, wall, {0, 0, 0}, {4, 1, 1});
    for (int i = 1; i < 4; ++i)
        reference::addQuad(scene, wall, {float(i), i % 2 == 1 ? 0.0f : kGap, 0}, {0, 1 - kGap, 0}, {0, 0, 1});
    reference::addQuad(scene, lamp, {3.99f, 0, 0}, {0, 0, 1}, {0, 1, 0});
    scene.cameras.push_back(reference::lookAt({0.05f, 0.5f, 0.5f}, {1.0f, 0.5f, 0.5f}, 1.0f));
    return scene;
}

} // namespace

// Paths without an unbiased suffix see two vertices from the camera and end at
// a third, where nothing was ever learned.
TEST_CASE("light of many bounces comes by the unbiased suffixes") {
    const Scene scene = chambers();
    PathTracerOptions deep = picture(16, 64);
    deep.samplesPerFrame = 16;
    deep.seed = 2;
    const double truth =
        meanLuminance(GpuRenderer(device(), scene).render(scene.cameras[0], deep, 8)); // +- 2 %
    const auto ratioWith = [&](float unbiasedShare) {
        NrcOptions options;
        options.paths = picture(32, 16);
        options.config = nrcPreset("fast");
        options.config.minRecords = 1024;
        options.config.unbiasedShare = unbiasedShare;
        CachedScene cached(device(), scene, options);
        cached.renderer().setWarmingUp(
            true); // frames that are looked at would train as a path tracer at first
        cached.learn(scene.cameras[0], 90);
        return meanLuminance(cached.view(scene.cameras[0], 8)) / truth;
    };
    // So few bright targets are still learned from after 90 frames.
    const double with = ratioWith(1.0f / 16.0f), without = ratioWith(0.0f);
    INFO("of the truth: " << with << " with unbiased suffixes, " << without << " without");
    CHECK(std::abs(std::log2(with)) < 0.6);
    CHECK(without < 0.3); // planted
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(device().validationMessages() == 0);
}
