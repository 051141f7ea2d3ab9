// Rendering with the cache as a whole: equal to path tracing where paths never end in it, unbiased as a
// control variate, and the same bits each time.
#include "engine/scene/lights/area_table.h"
#include "engine/scene/load_scene.h"
#include "nrc/renderer/nrc_renderer.h"
#include "tests/reference/z_test.h"
#include "tests/support/cached_scene.h"
#include "tests/support/expect_error.h"
#include "tests/support/gpu_render.h"
#include "tests/support/validated_device.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <limits>

using namespace irradia;
using namespace irradia::test;

namespace {

Device& device() {
    return deviceWith(QuadAccess::Texel);
}

struct Loaded {
    explicit Loaded(const std::string& name)
        : scene(loadScene(IRRADIA_BIN_DIR "/../scenes/" + name + ".glb"))
        , camera(scene.cameras.at(0))
        , bounds(sceneBounds(scene))
        , gpu(uploadScene(device(), packScene(scene), buildBvh(scene)))
        , withAreaTable(uploadScene(device(), recordsWithTable(), buildBvh(scene))) {}
    PackedScene recordsWithTable() const {
        PackedScene packed = packScene(scene);
        packAreaTable(packed);
        return packed;
    }
    Scene scene;
    Camera camera;
    Bounds bounds;
    GpuScene gpu, withAreaTable;
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

// Of an unfair comparison: were the samples of either method cut at some brightness, its picture would not
// grow with the lamps.
TEST_CASE("neither method cuts bright samples: lamps 2^20 times as strong give 2^20 times the picture, to "
          "the bit") {
    constexpr float kFactor = 1 << 20;
    Scene bright = cornell().scene;
    for (Material& material : bright.materials) material.emission *= kFactor;
    const GpuScene gpu = uploadScene(device(), packScene(bright), buildBvh(bright));
    NrcOptions never = options(48);
    never.config.spread = never.config.trainingSpread = std::numeric_limits<float>::infinity();
    NrcRenderer renderer(device(), gpu, cornell().bounds, never);
    WavefrontPathTracer tracer(device(), gpu, never.paths);
    for (uint32_t i = 0; i < 4; ++i) {
        renderer.renderFrame(cornell().camera, i);
        tracer.renderFrame(cornell().camera, i);
    }
    std::vector<glm::vec3> expected = renderPlain(never, 4).mean;
    for (glm::vec3& pixel : expected) pixel *= kFactor;
    const bool isSame = renderer.tracer().readFilm().mean == expected,
               isSameWithoutCache = tracer.readFilm().mean == expected;
    CHECK(isSame);
    CHECK(isSameWithoutCache);
    CHECK(std::ranges::max(expected, {}, &glm::vec3::r).r > kFactor); // some samples are brighter than 1
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
    biased.setWarmingUp(true); // else what knows nothing is not shown
    for (uint32_t i = 0; i < kFrames; ++i) biased.renderFrame(cornell().camera, i);
    CHECK_FALSE(reference::zTest(toEstimate(biased.tracer().readFilm()), expected).accepted());
}

namespace {

struct Trained {
    std::vector<glm::vec3> picture;
    std::vector<float> weights;
    uint32_t records = 0; // of the last frame

    bool operator==(const Trained&) const = default;
};

// 16 frames that train, and one that does not.
Trained train(const GpuScene& scene, float uniformShare) {
    NrcOptions training = options(48);
    training.config.uniformShare = uniformShare;
    NrcRenderer renderer(device(), scene, cornell().bounds, training);
    for (uint32_t i = 0; i < 16; ++i) renderer.renderFrame(cornell().camera, i);
    Trained trained{renderer.tracer().readFilm().mean, trainerOf(renderer).parameters(Weights::Raw),
                    renderer.counts().records};
    renderer.setLearning(false);
    renderer.renderFrame(cornell().camera, 16);
    const bool isAsItWas = trainerOf(renderer).parameters(Weights::Raw) == trained.weights;
    CHECK(isAsItWas);
    return trained;
}

} // namespace

TEST_CASE("frames that train have the same bits each time, and those that do not leave the cache as it is") {
    const Trained without = train(cornell().gpu, 0.0f), with = train(cornell().withAreaTable, 0.05f);
    const bool isSame = train(cornell().withAreaTable, 0.0f) == without, // the table alone changes nothing
        isSameWithShare = train(cornell().withAreaTable, 0.05f) == with;
    CHECK(isSame);
    CHECK(isSameWithShare);
    CHECK(with.weights != without.weights);
}

TEST_CASE("a share of uniform records changes neither the number of records nor what is seen") {
    NrcOptions uniform = options(48);
    const std::vector<glm::vec3> plain = renderPlain(uniform, 4).mean;
    for (const float share : {0.05f, 1.0f}) {
        uniform.config = options(48).config;
        uniform.config.uniformShare = share;
        NrcRenderer usual(device(), cornell().withAreaTable, cornell().bounds, uniform);
        for (uint32_t i = 0; i < 6; ++i) usual.renderFrame(cornell().camera, i);
        INFO("share " << share << ": " << usual.counts().records << " records");
        CHECK(usual.counts().records > 0.8 * uniform.config.minRecords);
        CHECK(usual.counts().records < 1.4 * uniform.config.minRecords);
        CHECK(usual.counts().skippedRecords == 0);

        // Where no path ends in the cache.
        uniform.config.spread = uniform.config.trainingSpread = std::numeric_limits<float>::infinity();
        NrcRenderer never(device(), cornell().withAreaTable, cornell().bounds, uniform);
        for (uint32_t i = 0; i < 4; ++i) never.renderFrame(cornell().camera, i);
        const bool isSame = never.tracer().readFilm().mean == plain;
        CHECK(isSame);
    }
}

TEST_CASE("the share of uniform records is configured as JSON, and needs an area table") {
    CHECK(nrcPreset("balanced").uniformShare == 0.0f);
    const auto share = [](const std::string& value) {
        return parseNrcConfig(R"({"base": "fast", "training": {"uniform_share": )" + value + "}}", "x")
            .uniformShare;
    };
    CHECK(share("0.05") == 0.05f);
    for (const char* value : {"-0.01", "1.5", "\"some\""})
        expectError(ExitCode::BadData, "training.uniform_share", [&] { share(value); });
    NrcOptions uniform = options(16);
    uniform.config.uniformShare = 0.05f;
    NrcRenderer renderer(device(), cornell().gpu, cornell().bounds, uniform);
    expectError(ExitCode::Internal, "area table", [&] { renderer.renderFrame(cornell().camera, 0); });
    // Without surfaces there is nothing to sample, and no table.
    const GpuScene nothing = uploadScene(device(), packScene(Scene{}), buildBvh(Scene{}));
    NrcRenderer empty(device(), nothing, Bounds{}, uniform);
    empty.renderFrame(cornell().camera, 0);
    CHECK(empty.counts().records == 0);
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(device().validationMessages() == 0);
}
