// The path tracer against the CPU reference on each of the project's own scenes: per-pixel z-test, block
// means and mean luminance. Small pictures by default; IRRADIA_FULL=1 renders 64x64 until the median pixel's
// sigma is at most 2 %.
#include "engine/scene/load_scene.h"
#include "tests/reference/path_tracer.h"
#include "tests/reference/z_test.h"
#include "tests/support/gpu_render.h"
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>

using namespace irradia;

namespace {

const std::string kScenes = IRRADIA_BIN_DIR "/../scenes/";
constexpr double kMedianSigma = 0.02;
constexpr double kMargin = 1.1;          // of the samples that seem to be missing
constexpr double kMeanAgreement = 0.005; // of the mean luminance; 3 sigma of its noise are added
constexpr uint32_t kMaxBounces = 8;
// Where few paths find the light, a pixel's variance is estimated from the few that did, and one in some
// hundred pixels is off by chance, with independent numbers (seed 200: 0.992 accepted) as with Sobol' points.
constexpr double kRareSigma = 0.15;
constexpr double kRareShare = 0.985; // of 256 pixels' channels

struct Picture {
    int size;
    int pilotSamples; // shows how noisy the scene is
    int sampleStep;   // samples come in multiples of it
    int sampleLimit;  // of a pixel
    bool mustReachSigma;
};

Picture wantedPicture() {
    if (std::getenv("IRRADIA_FULL")) return {64, 1024, 1024, 1 << 19, true}; // door-room: an hour
    return {16, 64, 64, 2048, false};
}

// Most light of door-room comes through the gap between the door's edge and the frame: up to the opposite
// post, and somewhat above the door. Its paths of little weight carry the light: none is ended by chance.
void helpDarkRoom(const std::string& name, reference::RenderSettings& settings) {
    if (name != "door-room") return;
    settings.portal = reference::Portal{{-0.71, 0.0, -0.55}, {0.71, 0.0, 0.35}, {0.0, 2.2, 0.0}};
    settings.rouletteBounce = settings.maxBounces + 1;
}

struct Rendered {
    int samples = 0; // of a pixel
    reference::ImageEstimate image;
    double sigma = 0.0; // median, relative
};

// Adds rounds of samples until the median sigma is kMedianSigma. A round is at most eight times what came
// before: few samples miss the rarest bright paths, and promise too much.
template <typename Render> // (samples, round) -> ImageEstimate
Rendered renderUntilQuiet(const Picture& picture, const Render& render) {
    Rendered all{picture.pilotSamples, render(picture.pilotSamples, 0), 0.0};
    for (uint32_t round = 1;; ++round) {
        all.sigma = reference::medianRelativeSigma(all.image);
        if (all.sigma <= kMedianSigma || all.samples + picture.sampleStep > picture.sampleLimit) return all;
        const double missing = all.samples * (std::pow(all.sigma / kMedianSigma, 2.0) * kMargin - 1.0);
        const double atMost = std::min(8 * all.samples, picture.sampleLimit - all.samples);
        const int more = std::max(static_cast<int>(std::min(missing, atMost)) / picture.sampleStep, 1) *
                         picture.sampleStep;
        all.image = reference::merged(all.image, all.samples, render(more, round), more);
        all.samples += more;
    }
}

// The GPU renders a pixel as kParts x kParts smaller ones, which under a box filter is the same picture: its
// waves are too small to be fast otherwise.
constexpr uint32_t kParts = 4;

reference::ImageEstimate ofWholePixels(const reference::ImageEstimate& parts) {
    reference::ImageEstimate image;
    image.width = parts.width / int(kParts);
    image.height = parts.height / int(kParts);
    image.mean.resize(size_t(image.width) * size_t(image.height));
    image.variance.resize(image.mean.size());
    constexpr double kShare = 1.0 / (kParts * kParts);
    for (size_t i = 0; i < parts.size(); ++i) {
        const size_t x = i % size_t(parts.width) / kParts, y = i / size_t(parts.width) / kParts;
        image.mean[y * size_t(image.width) + x] += kShare * parts.mean[i];
        image.variance[y * size_t(image.width) + x] += kShare * kShare * parts.variance[i];
    }
    return image;
}

void compareWithReference(const std::string& name) {
    Scene scene = loadScene(kScenes + name + ".glb");
    const CameraFile chosen = chooseCamera(scene, name == "glossy-room" ? kScenes + name + ".json" : "");
    if (!chosen.environment.empty()) scene.environment = loadEnvironment(chosen.environment);
    const Picture picture = wantedPicture();

    const reference::PathTracer tracer(scene);
    const Rendered cpu = renderUntilQuiet(picture, [&](int samples, uint32_t round) {
        reference::RenderSettings settings;
        settings.width = settings.height = picture.size;
        settings.samples = samples;
        settings.maxBounces = int(kMaxBounces);
        settings.seed = 1 + round;
        helpDarkRoom(name, settings);
        return tracer.render(chosen.camera, settings);
    });
    DeviceOptions deviceOptions;
    deviceOptions.validation = true;
    Device device(deviceOptions);
    test::GpuRenderer renderer(device, scene);
    const Rendered gpu = renderUntilQuiet(picture, [&](int samples, uint32_t round) {
        const auto ofPart = static_cast<uint32_t>(samples) / (kParts * kParts);
        PathTracerOptions options;
        options.width = options.height = static_cast<uint32_t>(picture.size) * kParts;
        options.maxBounces = kMaxBounces;
        options.seed = 1 + round;
        options.samplesPerFrame = std::bit_floor(std::clamp(ofPart / 256, 1u, 64u));
        return ofWholePixels(
            test::toEstimate(renderer.render(chosen.camera, options, ofPart / options.samplesPerFrame)));
    });

    const reference::ZTestResult result = reference::zTest(gpu.image, cpu.image);
    WARN(name << ": " << gpu.samples << " samples against " << cpu.samples << ", median sigma " << gpu.sigma
              << " and " << cpu.sigma << ": " << result.summary());
    if (picture.mustReachSigma) CHECK(std::max(gpu.sigma, cpu.sigma) <= kMedianSigma);
    CHECK(result.accepted(gpu.sigma > kRareSigma ? kRareShare : 0.9975));
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
