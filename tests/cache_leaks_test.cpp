// What a cache learns in one place shows in another only where its inputs let
// it: a lamp in the next room, the lit side of a thin wall.
#include "tests/reference/random.h"
#include "tests/reference/simple_scenes.h"
#include "tests/support/cached_scene.h"
#include "tests/support/gpu_render.h"
#include "tests/support/kernel_harness.h"
#include "tests/support/trainer_harness.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <fmt/format.h>

using namespace irradia;
using namespace irradia::test;

// ---- a lamp in the next room ----

namespace {

// Points of two rooms side by side, of which the first is grey, with some
// pattern, and so is the second until its red lamp is on.
TrainingRecords twoRooms(uint32_t count, double shareOfSecond, bool isLampOn, uint64_t seed) {
    reference::Random random(seed);
    TrainingRecords records;
    for (uint32_t i = 0; i < count; ++i) {
        const bool isSecond = random.uniform() < shareOfSecond;
        const double x = 0.45 * random.uniform() + (isSecond ? 0.55 : 0.0), y = random.uniform(),
                     z = random.uniform();
        for (const double input : {x, y, z, 0.5, 0.5})
            records.inputs.push_back(double(static_cast<float>(input)));
        const double grey = 0.5 + 0.3 * std::sin(6.0 * y) * std::sin(6.0 * z);
        const bool isRed = isSecond && isLampOn;
        for (uint32_t o = 0; o < kTrainerOutputs; ++o)
            records.targets.push_back(isRed ? (o == 0 ? 4.0 : 0.2) : grey);
    }
    return records;
}

ModelConfig modelWith(const std::string& positionEncoding) {
    return parseModelConfig(fmt::format(R"({{
        "encoding": {{"otype": "Composite", "nested": [{}, {{"otype": "Identity"}}]}},
        "network": {{"otype": "FullyFusedMLP", "n_neurons": 32, "n_hidden_layers": 2}},
        "loss": {{"otype": "RelativeL2Luminance", "epsilon": 0.01}},
        "optimizer": {{"otype": "Ema", "decay": 0.9, "nested": {{"otype": "Adam", "learning_rate": 0.01,
            "beta1": 0.9, "beta2": 0.99, "epsilon": 1e-15, "l2_reg": 1e-6}}}}}})",
                                        positionEncoding),
                            "model");
}

constexpr const char* kIdentity = R"({"otype": "Identity", "n_dims_to_encode": 3})";
constexpr const char* kTriangleWave =
    R"({"otype": "TriangleWave", "n_dims_to_encode": 3, "n_frequencies": 12})";
constexpr const char* kHashGrid =
    R"({"otype": "HashGrid", "n_dims_to_encode": 3, "n_levels": 8,
    "n_features_per_level": 2, "log2_hashmap_size": 14, "base_resolution": 4, "per_level_scale": 1.6})";

// Mean of |red - the others| in the first room, where it should be 0, soon
// after the lamp was switched.
double tintWith(const char* positionEncoding) {
    constexpr uint32_t kRecords = 2 * kTrainerBatch;
    TrainerHarness harness(modelWith(positionEncoding));
    for (uint64_t pass = 0; pass < 20; ++pass)
        harness.train(twoRooms(kRecords, 0.5, false, pass), 2, {.steps = 16});
    for (uint64_t pass = 0; pass < 6; ++pass)
        harness.train(twoRooms(kRecords, 0.5, true, 100 + pass), 2, {.steps = 16});
    const std::vector<double> seen = harness.predict(twoRooms(kRecords, 0.0, true, 1000), Weights::Ema);
    double tint = 0.0;
    for (size_t row = 0; row < kRecords; ++row)
        tint += std::abs(seen[3 * row] - 0.5 * (seen[3 * row + 1] + seen[3 * row + 2])) / kRecords;
    return tint;
}

} // namespace

TEST_CASE("a lamp tints the next room less where positions have features of "
          "their own") {
    const double grid = tintWith(kHashGrid), wave = tintWith(kTriangleWave), identity = tintWith(kIdentity);
    INFO(fmt::format("tint: hash grid {:.3f}, triangle wave {:.3f}, identity {:.3f}", grid, wave, identity));
    CHECK(grid < 0.05);       // of grey 0.5
    CHECK(3.0 * grid < wave); // planted: networks that share all they have
    CHECK(3.0 * grid < identity);
}

// ---- a thin wall ----

namespace {

// A box in two halves by a wall without thickness; the first half has the
// stronger lamp. Two cameras look at the wall, one in each half.
Scene dividedBox() {
    Scene scene;
    const uint32_t wall = reference::addMaterial(scene, reference::lambert(glm::vec3(0.7f))),
                   strong = reference::addMaterial(scene, reference::lambert({}, glm::vec3(10.0f))),
                   weak = reference::addMaterial(scene, reference::lambert({}, glm::vec3(1.0f)));
    addRoom(scene, wall, glm::vec3(-1.0f), glm::vec3(1.0f));
    reference::addQuad(scene, wall, {0, -1, -1}, {0, 2, 0}, {0, 0, 2});
    for (const auto& [lamp, x] : {std::pair{strong, -0.7f}, {weak, 0.3f}})
        reference::addQuad(scene, lamp, {x, 0.99f, -0.3f}, {0.4f, 0, 0}, {0, 0, 0.6f});
    for (const float x : {-0.95f, 0.95f})
        scene.cameras.push_back(reference::lookAt({x, 0.0f, 0.0f}, glm::vec3(0.0f), 1.2f));
    return scene;
}

PathTracerOptions picture() {
    PathTracerOptions options;
    options.width = options.height = 32;
    return options;
}

// An input that is not looked at, and one that is.
EncodingConfig ignored(uint32_t dims) {
    return makeEncoding("Identity", dims, {{"scale", 0.0}});
}
EncodingConfig blobs(uint32_t dims) {
    return makeEncoding("OneBlob", dims);
}

// Means of what the cache says of the wall's two sides, over the truth.
std::pair<double, double> sidesOfWall(bool withNormal) {
    const Scene scene = dividedBox();
    NrcOptions options;
    options.paths = picture();
    options.config = nrcPreset("fast");
    options.config.minRecords = 1024;
    options.config.endDepth = 0;
    options.paths.maxBounces = 2; // all scattered light is the cache's
    options.config.suffixBounces = 4;
    std::vector<EncodingConfig>& encoding = options.config.model.encoding;
    // The direction tells the sides apart as well: only one of them sends light
    // into it.
    encoding = {encoding.front(), ignored(2), withNormal ? blobs(2) : ignored(2), blobs(1), encoding.back()};
    CachedScene cached(validatedDevice(), scene, options);
    for (int frame = 0; frame < 40; ++frame)
        for (const Camera& camera : scene.cameras) cached.learn(camera, 1);
    std::vector<double> ratios;
    for (const Camera& camera : scene.cameras) {
        PathTracerOptions paths = picture();
        paths.seed = 2;
        paths.samplesPerFrame = 16; // errs by 2 %
        const FilmImage truth = GpuRenderer(validatedDevice(), scene).render(camera, paths, 1);
        ratios.push_back(meanLuminance(cached.view(camera)) / meanLuminance(truth));
    }
    return {ratios[0], ratios[1]};
}

} // namespace

TEST_CASE("light does not leak through a thin wall whose sides differ by their "
          "normals") {
    const auto [bright, dark] = sidesOfWall(true);
    const auto [brightWithout, darkWithout] = sidesOfWall(false);
    INFO(fmt::format("sides over truth: {:.2f} {:.2f} with normals, {:.2f} {:.2f} without", bright, dark,
                     brightWithout, darkWithout));
    CHECK(std::abs(bright - 1.0) < 0.25); // after 80 frames it is still learned
    CHECK(std::abs(std::log2(dark)) < 1.0);
    CHECK(darkWithout > 4.0); // planted
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(validatedDevice().validationMessages() == 0);
}
