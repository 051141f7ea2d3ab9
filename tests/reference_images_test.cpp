// The path tracer against the CPU reference on each of the project's own scenes: per-pixel z-test, block
// means and mean luminance. Small pictures by default; IRRADIA_FULL=1 renders 64x64 until the median pixel's
// sigma is at most 2 %.
#include "engine/scene/load_scene.h"
#include "tests/reference/path_tracer.h"
#include "tests/reference/z_test.h"
#include "tests/support/gpu_render.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>

using namespace irradia;

namespace {

const std::string kScenes = IRRADIA_BIN_DIR "/../scenes/";
constexpr double kMedianSigma = 0.02;
constexpr uint32_t kMaxBounces = 8;

struct Picture {
    int size;
    int pilotSamples; // shows how noisy the scene is
    int sampleLimit;  // of a pixel
    double meanAgreement;
};

// The default pictures leave the mean as noisy as they are: 3 sigma are added to what must agree.
Picture wantedPicture() {
    if (std::getenv("IRRADIA_FULL"))
        return {64, 512, 1 << 13, 0.005}; // door-room alone would want 2e5: an hour
    return {16, 64, 512, 0.005};
}

reference::ImageEstimate renderGpu(Device& device, const Scene& scene, const Camera& camera, int size,
                                   int samples) {
    PathTracerOptions options;
    options.width = options.height = static_cast<uint32_t>(size);
    options.maxBounces = kMaxBounces;
    options.samplesPerFrame = static_cast<uint32_t>(std::max(samples / 256, 1));
    const uint32_t frames = static_cast<uint32_t>(samples) / options.samplesPerFrame;
    return test::toEstimate(test::GpuRenderer(device, scene).render(camera, options, frames));
}

reference::ImageEstimate renderCpu(const reference::PathTracer& tracer, const Camera& camera, int size,
                                   int samples) {
    reference::RenderSettings settings;
    settings.width = settings.height = size;
    settings.samples = samples;
    settings.maxBounces = int(kMaxBounces);
    return tracer.render(camera, settings);
}

void compareWithReference(const std::string& name) {
    Scene scene = loadScene(kScenes + name + ".glb");
    const CameraFile chosen = chooseCamera(scene, name == "glossy-room" ? kScenes + name + ".json" : "");
    if (!chosen.environment.empty()) scene.environment = loadEnvironment(chosen.environment);

    const Picture picture = wantedPicture();
    const reference::PathTracer tracer(scene);
    const double pilot =
        reference::medianRelativeSigma(renderCpu(tracer, chosen.camera, picture.size, picture.pilotSamples));
    const double wanted = picture.pilotSamples * std::pow(pilot / kMedianSigma, 2.0) * 1.25;
    const int samples = static_cast<int>(std::clamp(wanted, 256.0, double(picture.sampleLimit)));

    DeviceOptions options;
    options.validation = true;
    Device device(options);
    const auto gpu = renderGpu(device, scene, chosen.camera, picture.size, samples);
    const auto cpu = renderCpu(tracer, chosen.camera, picture.size, samples);
    const reference::ZTestResult result = reference::zTest(gpu, cpu);
    WARN(name << ", " << samples << " samples, median sigma " << reference::medianRelativeSigma(gpu)
              << " and " << reference::medianRelativeSigma(cpu) << ": " << result.summary());
    CHECK(result.accepted());
    CHECK(device.validationMessages() == 0);
    CHECK(std::abs(result.meanRatio - 1.0) < picture.meanAgreement + 3.0 * result.meanRatioSigma);
}

} // namespace

TEST_CASE("cornell-box agrees with the CPU reference") {
    compareWithReference("cornell-box");
}
TEST_CASE("door-room agrees with the CPU reference") {
    compareWithReference("door-room");
}
TEST_CASE("glossy-room agrees with the CPU reference") {
    compareWithReference("glossy-room");
}
TEST_CASE("lamp-gallery agrees with the CPU reference") {
    compareWithReference("lamp-gallery");
}
TEST_CASE("interior agrees with the CPU reference") {
    compareWithReference("interior");
}
TEST_CASE("furnace-sphere agrees with the CPU reference") {
    compareWithReference("furnace-sphere");
}
