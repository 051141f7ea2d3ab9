// The wavefront path tracer as a whole: analytic scenes, bit-repeatability, and the CPU reference on a small
// box.
#include "tests/reference/path_tracer.h"
#include "tests/reference/simple_scenes.h"
#include "tests/reference/z_test.h"
#include "tests/support/gpu_render.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using test::picture;

namespace {

Device& device() {
    // Never destroyed: the validation layer is gone when statics are.
    static Device* shared = [] {
        DeviceOptions options;
        options.validation = true;
        return new Device(options);
    }();
    return *shared;
}

double meanLuminance(const FilmImage& film) {
    double sum = 0.0;
    for (const glm::vec3& v : film.mean) sum += 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z;
    return sum / double(film.mean.size());
}

Scene furnace(const glm::vec3& albedo, const glm::vec3& emission) {
    Scene scene;
    const uint32_t wall = reference::addMaterial(scene, reference::lambert(albedo, emission));
    reference::addSphereFromInside(scene, wall, glm::vec3(0.0f), 1.0f, 16);
    return scene;
}

reference::ImageEstimate renderReference(const Scene& scene, int size, int samples, int maxBounces) {
    reference::RenderSettings settings;
    settings.width = size;
    settings.height = size;
    settings.samples = samples;
    settings.maxBounces = maxBounces;
    return reference::PathTracer(scene).render(scene.cameras.at(0), settings);
}

} // namespace

TEST_CASE("a closed Lambert sphere of albedo 1/2 and emission 1/2 has radiance 1") {
    const Scene scene = furnace(glm::vec3(0.5f), glm::vec3(0.5f));
    test::GpuRenderer renderer(device(), scene);
    const Camera camera = reference::lookAt({0.1f, 0.2f, 0.0f}, {0.0f, 0.0f, 1.0f}, 1.2f);
    const FilmImage film = renderer.render(camera, picture(32, 64), 256);
    for (const glm::vec3& v : film.mean) REQUIRE(std::isfinite(v.x + v.y + v.z));
    // 2.6e5 paths of relative deviation below 0.6: sigma of the mean about 1e-3 at most.
    CHECK(std::abs(meanLuminance(film) - 1.0) < 0.005);
    // The same test must see 2 % more light.
    CHECK_FALSE(std::abs(1.02 * meanLuminance(film) - 1.0) < 0.005);
}

TEST_CASE("a cut path keeps the light of its edges and no more") {
    // Radiance of paths of at most B + 2 edges in the sphere: emission times the sum of albedo^k, k = 0 .. B
    // + 1.
    const Scene scene = furnace(glm::vec3(0.5f), glm::vec3(0.5f));
    test::GpuRenderer renderer(device(), scene);
    const Camera camera = reference::lookAt(glm::vec3(0.0f), {0.0f, 0.0f, 1.0f}, 1.2f);
    for (const uint32_t sampler : {gpu::kSamplerRandom, gpu::kSamplerSobol})
        for (uint32_t bounces = 0; bounces <= 10; ++bounces) {
            PathTracerOptions options = picture(32, bounces);
            options.sampler = sampler;
            const FilmImage film = renderer.render(camera, options, 64);
            const double expected = 1.0 - std::pow(0.5, bounces + 2.0);
            INFO("sampler " << sampler << ", max bounces " << bounces);
            CHECK(std::abs(meanLuminance(film) / expected - 1.0) < 0.005);
            CHECK_FALSE(std::abs(1.02 * meanLuminance(film) / expected - 1.0) < 0.005);
        }
}

TEST_CASE("the small box agrees with the CPU reference") {
    const Scene scene = reference::smallBox();
    test::GpuRenderer renderer(device(), scene);
    for (const uint32_t bounces : {0u, 1u, 16u}) {
        const auto gpu = test::toEstimate(renderer.render(scene.cameras.at(0), picture(24, bounces), 512));
        const auto cpu = renderReference(scene, 24, 1024, int(bounces));
        const reference::ZTestResult result = reference::zTest(gpu, cpu);
        INFO("max bounces " << bounces << ": " << result.summary());
        CHECK(result.accepted());
        CHECK(std::abs(result.meanRatio - 1.0) < 0.005 + 3.0 * result.meanRatioSigma);

        auto brighter = gpu; // 2 % more light must be seen
        for (auto& v : brighter.mean) v *= 1.02;
        for (auto& v : brighter.variance) v *= 1.02 * 1.02;
        CHECK_FALSE(reference::zTest(brighter, cpu).accepted());
    }
}

TEST_CASE("the same frames are bit-identical, whatever the wave size, the grouping or the form of records") {
    const Scene scene = reference::smallBox();
    test::GpuRenderer renderer(device(), scene);
    const Camera camera = scene.cameras.at(0);
    PathTracerOptions options = picture(40, 8);
    const FilmImage first = renderer.render(camera, options, 4);
    CHECK(renderer.render(camera, options, 4).mean == first.mean);
    for (const uint32_t wave : {1600u, 333u, 64u}) {
        options.waveSize = wave;
        CHECK(renderer.render(camera, options, 4).mean == first.mean);
    }
    options.waveSize = 0;
    options.seed = 2;
    CHECK(renderer.render(camera, options, 4).mean != first.mean);

    // A frame of several samples is the mean of them: equal up to the rounding of sums.
    options.seed = 1;
    options.samplesPerFrame = 4;
    const FilmImage grouped = renderer.render(camera, options, 1);
    for (size_t i = 0; i < first.mean.size(); ++i)
        for (int c = 0; c < 3; ++c)
            CHECK(std::abs(grouped.mean[i][c] - first.mean[i][c]) <=
                  1e-5f * std::max(first.mean[i][c], 1e-3f));
}

TEST_CASE("storage-buffer kernels give the picture of the texel-view kernels") {
    const Scene scene = reference::smallBox();
    DeviceOptions options;
    options.quads = QuadAccess::Storage;
    options.validation = true;
    Device storage(options);
    const FilmImage a = test::GpuRenderer(device(), scene).render(scene.cameras.at(0), picture(32, 4), 4);
    const FilmImage b = test::GpuRenderer(storage, scene).render(scene.cameras.at(0), picture(32, 4), 4);
    size_t different = 0;
    for (size_t i = 0; i < a.mean.size(); ++i) different += a.mean[i] != b.mean[i];
    CHECK(different == 0);
    CHECK(storage.validationMessages() == 0);
}

TEST_CASE("surfaces of the first hit") {
    Scene scene;
    const uint32_t wall = reference::addMaterial(scene, reference::lambert({0.25f, 0.5f, 0.75f}));
    reference::addQuad(scene, wall, {-10, -10, -2}, {20, 0, 0}, {0, 20, 0});
    const Camera camera = reference::lookAt(glm::vec3(0.0f), {0.0f, 0.0f, -1.0f}, 1.0f);
    PathTracerOptions options = picture(8, 0);
    options.layers = true;
    const FilmImage film = test::GpuRenderer(device(), scene).render(camera, options, 2);
    for (size_t i = 0; i < film.mean.size(); ++i) {
        CHECK(glm::length(film.albedo[i] - glm::vec3(0.25f, 0.5f, 0.75f)) < 1e-6f);
        CHECK(glm::length(film.normal[i] - glm::vec3(0, 0, 1)) < 1e-4f); // octahedral, 16 bits
        CHECK(std::abs(film.depth[i] - 2.0f) < 1e-5f);
        CHECK(std::abs(film.position[i].z + 2.0f) < 1e-5f);
    }
    const Camera away = reference::lookAt(glm::vec3(0.0f), {0.0f, 0.0f, 1.0f}, 1.0f);
    CHECK(std::isinf(test::GpuRenderer(device(), scene).render(away, options, 2).depth[0]));
}

TEST_CASE("a scene without triangles shows its environment, one without light is black") {
    Scene scene;
    scene.environment.constant = {0.5f, 1.0f, 2.0f};
    const Camera camera = reference::lookAt(glm::vec3(0.0f), {0.0f, 0.0f, 1.0f}, 1.0f);
    for (const glm::vec3& v : test::GpuRenderer(device(), scene).render(camera, picture(8, 4), 2).mean)
        CHECK(v == glm::vec3(0.5f, 1.0f, 2.0f));
    const Scene dark = furnace(glm::vec3(0.5f), glm::vec3(0.0f));
    for (const glm::vec3& v : test::GpuRenderer(device(), dark).render(camera, picture(8, 4), 2).mean)
        CHECK(v == glm::vec3(0.0f));
}

TEST_CASE("no validation messages") {
    CHECK(device().validationMessages() == 0);
}
