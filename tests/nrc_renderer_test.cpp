// Rendering with the cache as a whole: equal to path tracing where paths never end in it, unbiased as a
// control variate, and the same bits each time.
#include "engine/scene/load_scene.h"
#include "nrc/renderer/nrc_renderer.h"
#include "tests/reference/z_test.h"
#include "tests/support/gpu_render.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>
#include <limits>

using namespace irradia;
using namespace irradia::test;

namespace {

Device& device() {
    return deviceWith(RecordAccess::Texel);
}

struct Loaded {
    explicit Loaded(const std::string& name)
        : scene(loadScene(IRRADIA_BIN_DIR "/../scenes/" + name + ".glb"))
        , camera(scene.cameras.at(0))
        , bounds(sceneBounds(scene))
        , gpu(uploadScene(device(), packScene(scene), buildBvh(scene), bounds)) {}
    Scene scene;
    Camera camera;
    Bounds bounds;
    GpuScene gpu;
};

const Loaded& cornell() {
    static const Loaded* loaded = new Loaded("cornell-box");
    return *loaded;
}

NrcOptions options(uint32_t size) {
    NrcOptions options;
    options.paths.width = options.paths.height = size;
    options.config = nrcPreset("fast");
    options.config.minRecords = 512;
    return options;
}

FilmImage renderPlain(const NrcOptions& options, uint32_t frames) {
    WavefrontPathTracer tracer(device(), cornell().gpu, options.paths);
    for (uint32_t i = 0; i < frames; ++i) tracer.renderFrame(cornell().camera, i);
    return tracer.readFilm();
}

} // namespace

TEST_CASE("paths that never end in the cache give the path tracer's picture, bit for bit") {
    NrcOptions never = options(48);
    never.config.adaptation.on = false;
    never.config.spread = never.config.trainingSpread = std::numeric_limits<float>::infinity();
    NrcRenderer renderer(device(), cornell().gpu, cornell().bounds, never);
    for (uint32_t i = 0; i < 4; ++i) renderer.renderFrame(cornell().camera, i);
    CHECK(renderer.counts().records > 100); // it has learned all the same
    CHECK(renderer.counts().training.steps == 4 * never.config.steps);
    const FilmImage film = renderer.tracer().readFilm(), plain = renderPlain(never, 4);
    CHECK(film.mean == plain.mean);
    CHECK(film.variance == plain.variance);
}

TEST_CASE("as a control variate the cache leaves no bias, whatever its weights") {
    NrcOptions checked = options(64);
    checked.paths.samplesPerFrame = 4;
    checked.paths.maxBounces = 6;
    checked.config.residualShare = 0.5f;
    NrcRenderer renderer(device(), cornell().gpu, cornell().bounds, checked);
    renderer.setLearning(false);
    constexpr uint32_t kFrames = 32;
    for (uint32_t i = 0; i < kFrames; ++i) renderer.renderFrame(cornell().camera, i);
    NrcOptions other = checked;
    other.paths.seed = 2;
    const auto expected = toEstimate(renderPlain(other, kFrames));
    const auto with = toEstimate(renderer.tracer().readFilm());
    const reference::ZTestResult result = reference::zTest(with, expected);
    INFO(result.summary());
    CHECK(result.accepted());
    CHECK(std::abs(result.meanRatio - 1.0) < 0.005 + 3.0 * result.meanRatioSigma);

    // Without its residual the same cache shows.
    checked.config.residualShare = 0.0f;
    NrcRenderer biased(device(), cornell().gpu, cornell().bounds, checked);
    biased.setLearning(false);
    for (uint32_t i = 0; i < kFrames; ++i) biased.renderFrame(cornell().camera, i);
    CHECK_FALSE(reference::zTest(toEstimate(biased.tracer().readFilm()), expected).accepted());
}

TEST_CASE("frames that train have the same bits each time, and those that do not leave the cache as it is") {
    std::vector<FilmImage> films;
    std::vector<std::vector<float>> weights;
    for (int run = 0; run < 2; ++run) {
        NrcRenderer renderer(device(), cornell().gpu, cornell().bounds, options(48));
        for (uint32_t i = 0; i < 16; ++i) renderer.renderFrame(cornell().camera, i);
        films.push_back(renderer.tracer().readFilm());
        weights.push_back(renderer.cache().trainer().parameters(Weights::Raw));
        renderer.setLearning(false);
        renderer.renderFrame(cornell().camera, 16);
        const bool isAsItWas = renderer.cache().trainer().parameters(Weights::Raw) == weights.back();
        CHECK(isAsItWas);
    }
    const bool isSameFilm = films[0].mean == films[1].mean, areSameWeights = weights[0] == weights[1];
    CHECK(isSameFilm);
    CHECK(areSameWeights);
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(device().validationMessages() == 0);
}
