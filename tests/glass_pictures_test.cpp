// Glass, screens, sheets and lamps without extent in whole pictures: against the reference path tracer, pixel
// by pixel, and in a white furnace.
#include "tests/reference/glass_scenes.h"
#include "tests/reference/path_tracer.h"
#include "tests/reference/simple_scenes.h"
#include "tests/reference/z_test.h"
#include "tests/support/gpu_render.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using test::picture;

namespace {

constexpr int kSize = 32;

Device& device() {
    return test::deviceWith(QuadAccess::Texel);
}

// By the path tracer on the device, and by the reference.
void agreeOn(const Scene& scene, uint32_t frames, int samples) {
    constexpr int kBounces = 12;
    const FilmImage film =
        test::GpuRenderer(device(), scene).render(scene.cameras.at(0), picture(kSize, kBounces), frames);
    for (const glm::vec3& v : film.mean) REQUIRE(std::isfinite(v.x + v.y + v.z));
    reference::RenderSettings settings;
    settings.width = settings.height = kSize;
    settings.samples = samples;
    settings.maxBounces = kBounces;
    const auto cpu = reference::PathTracer(scene).render(scene.cameras.at(0), settings);
    const auto gpu = test::toEstimate(film);
    const auto agrees = [&](const reference::ImageEstimate& estimate) {
        const reference::ZTestResult result = reference::zTest(estimate, cpu);
        WARN(result.summary());
        return result.accepted() && std::abs(result.meanRatio - 1.0) < 0.005 + 3.0 * result.meanRatioSigma;
    };
    CHECK(agrees(gpu));
    auto brighter = gpu; // 3 % more light must be seen
    for (auto& v : brighter.mean) v *= 1.03;
    for (auto& v : brighter.variance) v *= 1.03 * 1.03;
    CHECK_FALSE(agrees(brighter));
    CHECK(device().validationMessages() == 0);
}

} // namespace

TEST_CASE("a ball of smooth glass agrees with the reference, flat or smooth-shaded") {
    agreeOn(reference::glassBall(false), 256, 384);
    agreeOn(reference::glassBall(true), 256, 384);
}

TEST_CASE("a rough, coloured, absorbing slab agrees with the reference") {
    agreeOn(reference::roughSlab(), 256, 384);
}

TEST_CASE("a coloured ball within a clear one agrees with the reference") {
    agreeOn(reference::nestedBalls(), 256, 384);
}

TEST_CASE("screens, masks, sheets, colours of vertices and turned pictures agree with the reference") {
    agreeOn(reference::screens(), 256, 384);
}

TEST_CASE("points, spots and directional lights agree with the reference") {
    agreeOn(reference::punctualRoom(), 256, 384);
}

TEST_CASE("white glass in a white furnace is white, at any roughness") {
    // A cube, whose faces' normals are its own: no ray is lost between shading and geometry.
    for (const float roughness : {0.0f, 0.3f, 1.0f})
        for (const bool isSolid : {true, false}) {
            INFO((isSolid ? "solid" : "sheets") << " of roughness " << roughness);
            Scene scene;
            scene.environment.constant = glm::vec3(1.0f);
            const uint32_t glass = reference::addMaterial(
                scene, isSolid ? reference::solidGlass(1.5f, roughness) : reference::glassSheet(roughness));
            reference::addCuboid(scene, glass, glm::vec3(-1.0f), glm::vec3(1.0f));
            const Camera camera = reference::lookAt({1.9f, 2.3f, 2.9f}, glm::vec3(0.0f), 0.45f);
            PathTracerOptions options = picture(16, 64);
            options.samplesPerFrame = 32;
            const FilmImage film = test::GpuRenderer(device(), scene).render(camera, options, 16);
            double mean = 0.0, variance = 0.0;
            for (size_t i = 0; i < film.mean.size(); ++i) {
                mean += film.mean[i].y / double(film.mean.size());
                variance += film.variance[i].y / double(film.mean.size() * film.mean.size());
            }
            const double sigma = std::sqrt(variance); // 0.003 at most
            WARN("mean " << mean << " +- " << sigma);
            CHECK(std::abs(mean - 1.0) < 0.002 + 3.0 * sigma);
            CHECK(sigma < 0.004);
        }
}

TEST_CASE("glass that is built wrong makes no light") {
    // In a closed room in which all is 1: balls within balls, more than a path can tell apart, and panes that
    // are called solid. Light may be lost at the last bounce, by paths that do not find out.
    const auto room = [] {
        Scene scene;
        reference::addSphereFromInside(
            scene, reference::addMaterial(scene, reference::lambert(glm::vec3(0.5f), glm::vec3(0.5f))),
            glm::vec3(0.0f), 2.0f, 12);
        return scene;
    };
    Scene nested = room(), open = room();
    for (int i = 0; i < 5; ++i) {
        const uint32_t glass = reference::addMaterial(
            nested, reference::solidGlass(i % 2 == 0 ? 1.5f : 2.0f, i % 2 == 0 ? 0.0f : 0.3f));
        reference::addSphere(nested, glass, glm::vec3(0.0f), 0.9f - 0.15f * float(i), 8, false);
    }
    const uint32_t pane = reference::addMaterial(open, reference::solidGlass(1.5f, 0.1f));
    for (int i = 0; i < 4; ++i) // their backs to the camera
        reference::addQuad(open, pane, {-0.8f, -0.8f, 0.2f * float(i)}, {0, 1.6f, 0}, {1.6f, 0, 0});
    const Camera camera = reference::lookAt({0, 0, 1.8f}, glm::vec3(0.0f), 0.9f);
    PathTracerOptions options = picture(16, 64);
    options.samplesPerFrame = 16;
    for (const Scene& scene : {nested, open}) {
        const FilmImage film = test::GpuRenderer(device(), scene).render(camera, options, 8);
        double mean = 0.0;
        float largest = 0.0f;
        for (const glm::vec3& v : film.mean) {
            mean += v.y / double(film.mean.size());
            largest = std::max(largest, v.y);
        }
        INFO("mean " << mean << ", largest " << largest);
        CHECK(mean < 1.005);
        CHECK(largest < 1.2f);                               // 128 samples, each at most some times 1
        if (scene.materials.size() == 2) CHECK(mean > 0.99); // the open one
    }
}
