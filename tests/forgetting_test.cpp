// What leaves the screen is forgotten, unless a share of the records comes from all surfaces: the cache
// learns one end of a hall, then the other, and is asked about the first again.
#include "engine/image/metrics.h"
#include "engine/scene/lights/area_table.h"
#include "nrc/renderer/nrc_renderer.h"
#include "tests/reference/simple_scenes.h"
#include "tests/support/kernel_harness.h"
#include <catch2/catch_test_macros.hpp>

using namespace irradia;

namespace {

// Without validation, which would take longer than the frames; nrc_renderer_test has them validated.
Device& device() {
    static Device device{DeviceOptions{}};
    return device;
}

// Six long, two wide and high; at one end red light on bluish walls, at the other blue light on reddish ones.
Scene hall() {
    Scene scene;
    for (const float end : {-1.0f, 1.0f}) {
        const glm::vec3 paint = end < 0.0f ? glm::vec3(0.5f, 0.6f, 0.8f) : glm::vec3(0.8f, 0.6f, 0.4f);
        const glm::vec3 light = end < 0.0f ? glm::vec3(12.0f, 4.0f, 1.5f) : glm::vec3(1.0f, 3.0f, 9.0f);
        const uint32_t wall = reference::addMaterial(scene, reference::lambert(paint));
        const uint32_t lamp = reference::addMaterial(scene, reference::lambert({}, light));
        const float low = end < 0.0f ? -3.0f : 0.0f;
        reference::addQuad(scene, wall, {low, -1, 1}, {3, 0, 0}, {0, 0, -2}); // floor
        reference::addQuad(scene, wall, {low, 1, -1}, {3, 0, 0}, {0, 0, 2});  // ceiling
        reference::addQuad(scene, wall, {low, -1, -1}, {3, 0, 0}, {0, 2, 0}); // sides
        reference::addQuad(scene, wall, {low + 3, -1, 1}, {-3, 0, 0}, {0, 2, 0});
        reference::addQuad(scene, wall, {3 * end, -1, -end}, {0, 0, 2 * end}, {0, 2, 0});
        reference::addQuad(scene, lamp, {2 * end - 0.3f, 0.99f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f});
        // A block, whose shadow is to be remembered too.
        const glm::vec3 at(2.3f * end - 0.3f, -1.0f, -0.1f);
        reference::addQuad(scene, wall, at + glm::vec3(0, 0.8f, 0.6f), {0.6f, 0, 0}, {0, 0, -0.6f});
        reference::addQuad(scene, wall, at + glm::vec3(0, 0, 0.6f), {0.6f, 0, 0}, {0, 0.8f, 0});
        reference::addQuad(scene, wall, at + glm::vec3(0.6f, 0, 0), {-0.6f, 0, 0}, {0, 0.8f, 0});
        reference::addQuad(scene, wall, at, {0, 0, 0.6f}, {0, 0.8f, 0});
        reference::addQuad(scene, wall, at + glm::vec3(0.6f, 0, 0.6f), {0, 0, -0.6f}, {0, 0.8f, 0});
    }
    return scene;
}

const Camera kFirstEnd = reference::lookAt({0, 0, 0}, {-3.0f, -0.1f, 0.0f}, 1.1f);
const Camera kOtherEnd = reference::lookAt({0, 0, 0}, {3.0f, -0.1f, 0.0f}, 1.1f);
constexpr uint32_t kSize = 32, kLearning = 150, kAway = 150;

// A network that is global: encoded by frequencies, as in the paper. Grids forget less by themselves.
NrcOptions options(float share, uint32_t seed) {
    NrcOptions options;
    options.seed = options.paths.seed = seed;
    options.paths.width = options.paths.height = kSize;
    options.paths.maxBounces = 1; // all else ends in the cache
    options.config = nrcPreset("faithful");
    options.config.model.network.hiddenLayers = 2;
    options.config.minRecords = 1024;
    options.config.suffixBounces = 3;
    options.config.adaptation.youth = 0; // long suffixes see the other end too
    options.config.endDepth = 0;         // what is seen is the cache at the first hit
    options.config.uniformShare = share;
    return options;
}

class Hall {
public:
    Hall()
        : scene_(hall())
        , bounds_(sceneBounds(scene_)) {
        PackedScene packed = packScene(scene_);
        packAreaTable(packed);
        gpu_ = uploadScene(device(), packed, buildBvh(scene_));
        truth_ = pathTraced();
    }

    struct Errors {
        double before = 0.0, after = 0.0; // MAPE of the first end
    };
    Errors forget(float share, uint32_t seed = 1) const {
        NrcRenderer renderer(device(), gpu_, bounds_, options(share, seed));
        uint32_t frame = 0;
        for (uint32_t i = 0; i < kLearning; ++i) renderer.renderFrame(kFirstEnd, frame++);
        Errors errors;
        errors.before = error(renderer, frame);
        for (uint32_t i = 0; i < kAway; ++i) renderer.renderFrame(kOtherEnd, frame++);
        errors.after = error(renderer, frame);
        return errors;
    }

    double forgetsOnAverage(float share) const { // MAPE after, of four seeds
        double sum = 0.0;
        for (uint32_t seed = 1; seed <= 4; ++seed) sum += forget(share, seed).after;
        return sum / 4.0;
    }

private:
    // Each pixel from 4 x 4 smaller ones: a few large frames take less time than many small ones.
    std::vector<glm::vec3> pathTraced() const {
        PathTracerOptions paths;
        paths.width = paths.height = 4 * kSize;
        WavefrontPathTracer tracer(device(), gpu_, paths);
        for (uint32_t i = 0; i < 24; ++i) tracer.renderFrame(kFirstEnd, i); // an error of some 4 %
        const std::vector<glm::vec3> fine = tracer.readFilm().mean;
        std::vector<glm::vec3> means(kSize * kSize);
        for (uint32_t i = 0; i < fine.size(); ++i)
            means[i / (16 * kSize) * kSize + i % (4 * kSize) / 4] += fine[i] / 16.0f;
        return means;
    }

    // Of the picture without a frame that learns.
    double error(NrcRenderer& renderer, uint32_t frame) const {
        renderer.setLearning(false);
        renderer.forgetFilm();
        for (uint32_t i = 0; i < 8; ++i) renderer.renderFrame(kFirstEnd, frame + i);
        const double mape = compareImages(kSize, kSize, renderer.tracer().readFilm().mean, truth_).mape;
        renderer.setLearning(true);
        return mape;
    }

    Scene scene_;
    Bounds bounds_;
    GpuScene gpu_;
    std::vector<glm::vec3> truth_;
};

} // namespace

// Four seeds, after: 0.281 without, 0.199 with a share of 0.05; the same four at another commit 0.327 and
// 0.184. By random numbers 0.254 and 0.153; 0.01 (ten records a frame) left 0.259, 0.02 left 0.235.
TEST_CASE("the cache remembers what it has seen with a share of uniform records, and forgets without") {
    const Hall hall;
    const Hall::Errors none = hall.forget(0.0f), twentieth = hall.forget(0.05f);
    INFO("MAPE before and after: " << none.before << ", " << none.after << "; with a share of 0.05 "
                                   << twentieth.before << ", " << twentieth.after);
    CHECK(none.after > 2.0 * none.before);
    CHECK(twentieth.before < 1.6 * none.before); // what is in sight suffers little
    // One seed decides little: of six, what is left with a share of 0.05 is from 0.12 to 0.25. The ratio of
    // two means of four has a standard deviation of 0.1, and is 1 where the share does nothing.
    const double without = hall.forgetsOnAverage(0.0f), with = hall.forgetsOnAverage(0.05f);
    INFO("mean of four seeds: " << without << "; with a share of 0.05 " << with);
    CHECK(with < 0.85 * without);
    if (!test::fullSweep()) return;
    const double hundredth = hall.forgetsOnAverage(0.01f);
    INFO("with a share of 0.01 " << hundredth);
    CHECK(with < 0.9 * hundredth);
}
