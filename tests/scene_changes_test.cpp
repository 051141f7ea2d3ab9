// A scene that changes on the device: the picture is that of the same state uploaded, bit for bit, and lamps
// that are off are not sampled.
#include "engine/scene/packed_scene.h"
#include "tests/reference/simple_scenes.h"
#include "tests/reference/z_test.h"
#include "tests/support/expect_error.h"
#include "tests/support/gpu_render.h"
#include "tests/support/validated_device.h"
#include <bit>
#include <catch2/catch_test_macros.hpp>

using namespace irradia;
using namespace irradia::test;

namespace {

Device& device() {
    return deviceWith(QuadAccess::Texel);
}

constexpr size_t kWhite = 0, kLampOfBox = 3, kSecondLamp = 6;

// The small box with a second lamp, which is off, on its floor.
Scene twoLamps() {
    Scene scene = reference::smallBox();
    const uint32_t second = reference::addMaterial(scene, reference::lambert(glm::vec3(0.0f)));
    reference::addQuad(scene, second, {-0.9f, -0.98f, 0.9f}, {0.3f, 0, 0}, {0, 0, -0.3f});
    return scene;
}

Scene lampsExchanged() {
    Scene scene = twoLamps();
    scene.materials[kLampOfBox].emission = glm::vec3(0.0f);
    scene.materials[kSecondLamp].emission = {3.0f, 5.0f, 8.0f};
    scene.materials[kWhite].baseColor = {0.2f, 0.5f, 0.9f};
    return scene;
}

Scene skyAlone() {
    Scene scene = twoLamps();
    scene.materials[kLampOfBox].emission = glm::vec3(0.0f);
    scene.environment.constant = {0.3f, 0.6f, 1.0f};
    return scene;
}

PlannedStates allStates() {
    PlannedStates states;
    for (const Scene& state : {twoLamps(), lampsExchanged(), skyAlone()}) states.include(state);
    return states;
}

GpuScene uploaded(const Scene& scene, const PlannedStates& states) {
    return uploadScene(device(), packScene(scene, states), buildBvh(scene));
}

PathTracerOptions options(uint32_t seed = 1) {
    PathTracerOptions options;
    options.width = options.height = 24;
    options.maxBounces = 3;
    options.samplesPerFrame = 8;
    options.seed = seed;
    return options;
}

FilmImage render(WavefrontPathTracer& tracer, uint32_t frames) {
    tracer.forgetFilm();
    for (uint32_t frame = 0; frame < frames; ++frame)
        tracer.renderFrame(reference::smallBox().cameras[0], frame);
    return tracer.readFilm();
}

} // namespace

TEST_CASE("a lamp that is off has a record without probability") {
    const PackedScene packed = packScene(lampsExchanged(), allStates());
    REQUIRE(packed.lights.size() == 4);
    for (size_t i = 0; i < 4; ++i) {
        const bool isOn = i >= 2; // triangles of the second lamp
        CHECK(std::bit_cast<float>(packed.lights[i].w) == (isOn ? 0.5f : 0.0f));
        if (!isOn) CHECK(std::bit_cast<float>(packed.lights[i].x) == 0.0f);
        CHECK(packed.lights[i].y >= 2); // whoever draws one that is off gets one that is on
    }
    CHECK(packed.lightShares.environment == 0.0f);
    CHECK(packScene(skyAlone(), allStates()).lightShares.environment == 1.0f);
    CHECK(packScene(twoLamps(), allStates()).needs.environment);
}

TEST_CASE("a changed scene gives the picture of that state") {
    GpuScene changing = uploaded(twoLamps(), allStates());
    WavefrontPathTracer tracer(device(), changing, options());
    for (const Scene& state : {lampsExchanged(), skyAlone(), twoLamps()}) {
        updateScene(device(), state, changing);
        const FilmImage film = render(tracer, 2);
        const GpuScene fresh = uploaded(state, allStates());
        WavefrontPathTracer freshTracer(device(), fresh, options());
        CHECK(film.mean == render(freshTracer, 2).mean);

        // Nothing is gained or lost by what the other states need.
        constexpr uint32_t kFrames = 16;
        const GpuScene alone = uploaded(state, {});
        WavefrontPathTracer aloneTracer(device(), alone, options(2));
        const auto result =
            reference::zTest(toEstimate(render(tracer, kFrames)), toEstimate(render(aloneTracer, kFrames)));
        INFO(result.summary());
        CHECK(result.accepted());
    }
}

TEST_CASE("lights without extent stay as they are when lamps and the environment change") {
    const auto lit = [](Scene scene) {
        for (const auto kind : {PunctualLight::Kind::Directional, PunctualLight::Kind::Point}) {
            PunctualLight light;
            light.kind = kind;
            light.intensity = {2.0f, 1.0f, 0.5f};
            light.position = {0.3f, 0.2f, 0.4f};
            scene.lights.push_back(light);
        }
        return scene;
    };
    CHECK(packScene(lit(twoLamps()), allStates()).lightShares.local == 0.5f);
    CHECK(packScene(lit(skyAlone()), allStates()).lightShares.local == 1.0f / 3.0f);
    GpuScene changing = uploaded(lit(twoLamps()), allStates());
    WavefrontPathTracer tracer(device(), changing, options());
    for (const Scene& state : {lampsExchanged(), skyAlone(), twoLamps()}) {
        updateScene(device(), lit(state), changing);
        const FilmImage film = render(tracer, 2);
        const GpuScene fresh = uploaded(lit(state), allStates());
        WavefrontPathTracer freshTracer(device(), fresh, options());
        CHECK(film.mean == render(freshTracer, 2).mean);
        CHECK(packScene(lit(state), allStates()).lights.size() == 4 + 1 + 2 * gpu::kPunctualQuads);
    }
}

TEST_CASE("a state that was not planned is refused") {
    GpuScene scene = uploaded(twoLamps(), {});
    expectError(ExitCode::Internal, "lamps", [&] { updateScene(device(), lampsExchanged(), scene); });
    expectError(ExitCode::Internal, "environment", [&] { updateScene(device(), skyAlone(), scene); });
    CHECK(device().validationMessages() == 0);
}
