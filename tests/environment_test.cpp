// Environments from files: which layer, what is mended, what is too large.
#include "engine/image/image.h"
#include "engine/scene/lights/environment_reduction.h"
#include "engine/scene/lights/packed_lights.h"
#include "engine/scene/load_scene.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <limits>

using namespace irradia;
using irradia::test::expectError;
using irradia::test::TemporaryFolder;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::string write(const std::filesystem::path& file, const std::vector<glm::vec3>& texels,
                  const std::string& layer = "") {
    LayeredImage image;
    image.width = static_cast<int>(texels.size());
    image.height = 1;
    image.setRgb(layer, texels);
    writeExr(file, image);
    return file.string();
}

// A value of its own at every texel.
Environment ramp(int width, int height) {
    Environment environment;
    environment.width = width;
    environment.height = height;
    for (int i = 0; i < width * height; ++i) environment.texels.emplace_back(i, 2 * i, 1);
    return environment;
}

glm::dvec3 mean(const Environment& environment) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& texel : environment.texels) sum += glm::dvec3(texel);
    return sum / double(environment.texels.size());
}

} // namespace

TEST_CASE("a sun that half floats cannot hold") {
    const TemporaryFolder folder;
    SceneNotes notes;
    const auto half = write(folder / "half.exr", {{1, 2, 3}, {kInfinity, kInfinity, 5}, {kInfinity, 0, 0}});
    CHECK(loadEnvironment(half, &notes).texels ==
          std::vector<glm::vec3>{{1, 2, 3}, {65504, 65504, 5}, {65504, 0, 0}});
    CHECK(notes.warnings == std::vector<std::string>{half + ": 2 of 3 texels are infinite and become 65504"});

    const auto bright = write(folder / "bright.exr", {{1e6f, 0, 0}, {0, kInfinity, 0}});
    CHECK(loadEnvironment(bright).texels[1] == glm::vec3(0, 1e6f, 0));
}

TEST_CASE("texels that are no light are black") {
    const TemporaryFolder folder;
    SceneNotes notes;
    const auto file = write(folder / "a.exr", {{kNan, 2, 3}, {-kInfinity, -1, 4}, {5, 6, 7}});
    CHECK(loadEnvironment(file, &notes).texels == std::vector<glm::vec3>{{0, 0, 0}, {0, 0, 4}, {5, 6, 7}});
    CHECK(notes.warnings ==
          std::vector<std::string>{file + ": 1 of 3 texels are no numbers and become black"});
}

TEST_CASE("an environment from a layer") {
    const TemporaryFolder folder;
    const auto file = write(folder / "sky.exr", {{1, 2, 3}}, "sun");
    CHECK(loadEnvironment(file + ":sun").texels == std::vector<glm::vec3>{{1, 2, 3}});
    expectError(ExitCode::BadData, "has no layer 'moon'", [&] { loadEnvironment(file + ":moon"); });
    expectError(ExitCode::BadData, "sky.exr: has no channel R, only sun.B, sun.G, sun.R",
                [&] { loadEnvironment(file); });
}

TEST_CASE("large environments are halved until they fit, and keep their mean") {
    Environment even = ramp(8, 4);
    reduceToFit(even, 32);
    CHECK(even.width == 8); // it fits
    reduceToFit(even, 31);
    REQUIRE((even.width == 4 && even.height == 2));
    CHECK(even.texels[0] == glm::vec3(4.5f, 9, 1));   // of 0, 1, 8, 9
    CHECK(even.texels[5] == glm::vec3(22.5f, 45, 1)); // of 18, 19, 26, 27

    Environment odd = ramp(7, 5);
    const glm::dvec3 before = mean(odd);
    reduceToFit(odd, 20);
    REQUIRE((odd.width == 4 && odd.height == 3));
    for (int c = 0; c < 3; ++c) CHECK(mean(odd)[c] == Catch::Approx(before[c]).epsilon(1e-6)); // of floats

    Environment sun = ramp(5, 1);
    sun.texels.assign(5, glm::vec3(0));
    sun.texels.back() = glm::vec3(5); // in the last column of an odd number
    reduceToFit(sun, 4);
    REQUIRE(sun.texels.size() == 3);
    CHECK(sun.texels[2].x == Catch::Approx(3)); // 5 of 5 / 3 texels
}

TEST_CASE("the reduction is told, its table is that of the smaller picture") {
    PackedScene packed;
    packEnvironment(ramp(8, 4), packed, 10);
    CHECK((packed.environmentWidth == 4 && packed.environmentHeight == 2));
    CHECK(packed.environment.size() == 8);
    CHECK(packed.environmentAlias.size() == 8);
    CHECK(packed.warnings == std::vector<std::string>{"the environment of 8x4 was reduced to 4x2 to fit"});

    PackedScene constant;
    packEnvironment({.constant = glm::vec3(1)}, constant, 10);
    CHECK(constant.warnings.empty());
}

TEST_CASE("a scene without light says so") {
    Scene scene;
    const auto told = [](const Scene& lit, const PlannedStates& states = {}) {
        const auto warnings = packScene(lit, states).warnings;
        return warnings.size() == 1 && warnings[0].starts_with("the scene has no light");
    };
    CHECK(told(scene));
    scene.environment.constant = glm::vec3(1);
    CHECK_FALSE(told(scene));
    scene.environment.constant = glm::vec3(0);
    scene.vertices = {{.position = {0, 0, 0}}, {.position = {1, 0, 0}}, {.position = {0, 1, 0}}};
    scene.triangles = {{{0, 1, 2}, 0}};
    scene.materials = {{.name = "dark"}, {.emission = glm::vec3(1)}};
    CHECK(told(scene)); // no triangle is of the lamp
    PlannedStates dawn;
    dawn.environment = true;
    CHECK_FALSE(told(scene, dawn)); // light will come
    scene.triangles[0].material = 1;
    CHECK_FALSE(told(scene));
}
