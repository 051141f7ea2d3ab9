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
constexpr double kPilotSigma = 0.1;
constexpr double kMargin = 1.15; // of the samples: a pilot of few samples misses the rarest bright paths
constexpr double kMeanAgreement = 0.005; // of the mean luminance; 3 sigma of its noise are added
constexpr uint32_t kMaxBounces = 8;

struct Picture {
    int size;
    int pilotSamples;   // at first: four times more until the pilot's median sigma is at most kPilotSigma
    int sampleLimit;    // of a pixel
    double medianSigma; // that the samples must reach; none where the limit comes first
};

Picture wantedPicture() {
    if (std::getenv("IRRADIA_FULL")) return {64, 1024, 1 << 19, kMedianSigma}; // door-room: an hour
    return {16, 64, 2048, 1.0};
}

// Most light of door-room comes through the gap between the door's edge and the frame: up to the opposite
// post, and somewhat above the door. Its paths of little weight carry the light: none is ended by chance.
void helpDarkRoom(const std::string& name, reference::RenderSettings& settings) {
    if (name != "door-room") return;
    settings.portal = reference::Portal{{-0.71, 0.0, -0.55}, {0.71, 0.0, 0.35}, {0.0, 2.2, 0.0}};
    settings.rouletteBounce = settings.maxBounces + 1;
}

// Samples of a pixel with which render(samples) has a median sigma of kMedianSigma.
template <typename Render>
int neededSamples(const Picture& picture, const Render& render) {
    int samples = picture.pilotSamples;
    double sigma = reference::medianRelativeSigma(render(samples));
    while (sigma > kPilotSigma && 16 * samples < picture.sampleLimit)
        sigma = reference::medianRelativeSigma(render(samples *= 4));
    const double needed = samples * std::pow(sigma / kMedianSigma, 2.0) * kMargin;
    return static_cast<int>(std::clamp(needed, 256.0, double(picture.sampleLimit)));
}

void compareWithReference(const std::string& name) {
    Scene scene = loadScene(kScenes + name + ".glb");
    const CameraFile chosen = chooseCamera(scene, name == "glossy-room" ? kScenes + name + ".json" : "");
    if (!chosen.environment.empty()) scene.environment = loadEnvironment(chosen.environment);
    const Picture picture = wantedPicture();

    const reference::PathTracer tracer(scene);
    const auto renderCpu = [&](int samples) {
        reference::RenderSettings settings;
        settings.width = settings.height = picture.size;
        settings.samples = samples;
        settings.maxBounces = int(kMaxBounces);
        helpDarkRoom(name, settings);
        return tracer.render(chosen.camera, settings);
    };
    DeviceOptions deviceOptions;
    deviceOptions.validation = true;
    Device device(deviceOptions);
    test::GpuRenderer renderer(device, scene);
    const auto renderGpu = [&](int samples) {
        PathTracerOptions options;
        options.width = options.height = static_cast<uint32_t>(picture.size);
        options.maxBounces = kMaxBounces;
        options.samplesPerFrame = static_cast<uint32_t>(std::clamp(samples / 256, 1, 64));
        const uint32_t frames = static_cast<uint32_t>(samples) / options.samplesPerFrame;
        return test::toEstimate(renderer.render(chosen.camera, options, frames));
    };

    const int gpuSamples = neededSamples(picture, renderGpu), cpuSamples = neededSamples(picture, renderCpu);
    const auto gpu = renderGpu(gpuSamples), cpu = renderCpu(cpuSamples);
    const reference::ZTestResult result = reference::zTest(gpu, cpu);
    const double gpuSigma = reference::medianRelativeSigma(gpu),
                 cpuSigma = reference::medianRelativeSigma(cpu);
    WARN(name << ": " << gpuSamples << " samples against " << cpuSamples << ", median sigma " << gpuSigma
              << " and " << cpuSigma << ": " << result.summary());
    CHECK(std::max(gpuSigma, cpuSigma) <= picture.medianSigma);
    CHECK(result.accepted());
    CHECK(device.validationMessages() == 0);
    CHECK(std::abs(result.meanRatio - 1.0) < kMeanAgreement + 3.0 * result.meanRatioSigma);
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
