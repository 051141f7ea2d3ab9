// What an EXR file says beside its pixels: primaries, the camera, and that there is a picture at all.
#include "engine/image/image.h"
#include "engine/path/film_image.h"
#include "engine/scene/camera_matrices.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using irradia::test::expectError;
using irradia::test::TemporaryFolder;

namespace {

// At (1, 2, 3) and looking along -X; +Z is to the left, so that -Z is to the right.
Camera sideways() {
    Camera camera;
    camera.position = {1, 2, 3};
    camera.forward = {-1, 0, 0};
    camera.up = {0, 1, 0};
    camera.verticalFov = 2.0f * std::atan(0.5f); // as high as far
    return camera;
}

bool near(const Imath::V3f& a, const Imath::V3f& b) {
    return (a - b).length() < 1e-5f; // a few roundings of numbers up to 10
}

} // namespace

TEST_CASE("an EXR says its primaries and the camera as OpenEXR's standard attributes") {
    const TemporaryFolder folder;
    LayeredImage image;
    image.width = 2;
    image.height = 1;
    image.setRgb("", std::vector<glm::vec3>(2, glm::vec3(1.0f)));
    image.matrices["worldToCamera"] = worldToCamera(sideways());
    image.matrices["worldToNDC"] = worldToNdc(sideways(), 2.0f);
    writeExr(folder / "a.exr", image);

    Imf::InputFile file((folder / "a.exr").c_str());
    REQUIRE(Imf::hasChromaticities(file.header()));
    const Imf::Chromaticities& primaries = Imf::chromaticities(file.header());
    // ITU-R BT.709-6, item 1.3 and 1.4.
    CHECK(primaries.red == Imath::V2f(0.64f, 0.33f));
    CHECK(primaries.green == Imath::V2f(0.30f, 0.60f));
    CHECK(primaries.blue == Imath::V2f(0.15f, 0.06f));
    CHECK(primaries.white == Imath::V2f(0.3127f, 0.3290f));

    // A point times a matrix, with the division by w, as the standard has it.
    REQUIRE(Imf::hasWorldToCamera(file.header()));
    const Imath::M44f toCamera = Imf::worldToCamera(file.header());
    CHECK(near(Imath::V3f(1, 2, 3) * toCamera, {0, 0, 0}));
    CHECK(near(Imath::V3f(-9, 2, 3) * toCamera, {0, 0, 10})); // seen objects have a positive z
    CHECK(near(Imath::V3f(1, 3, 3) * toCamera, {0, 1, 0}));
    CHECK(near(Imath::V3f(1, 2, 2) * toCamera, {1, 0, 0}));

    // The picture at a distance of 4 is 4 high and 8 wide.
    REQUIRE(Imf::hasWorldToNDC(file.header()));
    const Imath::M44f toNdc = Imf::worldToNDC(file.header());
    CHECK(near(Imath::V3f(-3, 2, 3) * toNdc, {0.5f, 0.5f, 0.25f}));
    CHECK(near(Imath::V3f(-3, 4, 7) * toNdc, {0, 0, 0.25f}));  // its upper left corner
    CHECK(near(Imath::V3f(-3, 0, -1) * toNdc, {1, 1, 0.25f})); // its lower right

    CHECK(readExr(folder / "a.exr").matrices == image.matrices);

    Camera parallel = sideways();
    parallel.halfHeight = 3; // 6 high and 12 wide at any distance
    for (const float x : {-3.0f, -9.0f}) {
        const glm::mat4 flat = worldToNdc(parallel, 2.0f);
        CHECK(glm::length(flat * glm::vec4(x, 5, 9, 1) - glm::vec4(0, 0, 1 - x, 1)) < 1e-5f);
        CHECK(glm::length(flat * glm::vec4(x, -1, -3, 1) - glm::vec4(1, 1, 1 - x, 1)) < 1e-5f);
    }

    const glm::mat4 shifted = worldToCamera(sideways(), {100, 200, 300});
    CHECK(shifted * glm::vec4(101, 202, 303, 1) == glm::vec4(0, 0, 0, 1));
}

TEST_CASE("a film without a frame is no picture") {
    FilmImage film;
    film.width = film.height = 1;
    film.mean = {glm::vec3(0.0f)};
    expectError(ExitCode::Internal, "no frame was rendered", [&] { toLayers(film); });
    film.frames = 1;
    CHECK(toLayers(film).channels.at("SampleCount.V") == std::vector{1.0f});
}
