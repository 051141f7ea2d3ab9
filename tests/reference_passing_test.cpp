// The reference path tracer through screens and clear sheets, and vertices' colours and turned pictures.
#include "tests/reference/glass_albedo.h"
#include "tests/reference/glass_scenes.h"
#include "tests/reference/measure.h"
#include "tests/reference/texture.h"
#include "tests/support/check_radiance.h"
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>

using namespace irradia;
using namespace irradia::reference;
using Catch::Approx;

namespace {

constexpr glm::vec3 kBlack(0.0f);

// From a unit above the origin of a wall, at cosine mu to it.
glm::vec3 eyeAt(double mu) {
    return {static_cast<float>(std::sqrt(1.0 - mu * mu)), 0.0f, static_cast<float>(mu)};
}

} // namespace

TEST_CASE("a clear sheet passes T and reflects the rest") {
    for (const double mu : {1.0, 0.5, 0.1}) {
        Scene scene;
        Material sheet = glassSheet(0.0f);
        sheet.baseColor = {0.9f, 0.5f, 0.2f};
        sheet.transmission = 0.75f;
        addWall(scene, sheet, 0.0f);
        scene.environment.constant = glm::vec3(2.0f);
        const Vec3 base(Vec3(sheet.baseColor));
        const Vec3 through = 0.75 * (1.0 - (0.04 + 0.96 * std::pow(1.0 - mu, 5.0))) * base;
        const Glass glass({base, 0.0, 0.0, Vec3(0.04), 1.0}, {GlassParameters::Kind::ClearSheet, 0.75});
        const Vec3 expected = 2.0 * (through + directionalAlbedo(glass, mu).reflected);
        for (const float side : {1.0f, -1.0f}) {
            glm::vec3 eye = eyeAt(mu);
            eye.z *= side;
            // No bounce is left, but passing is none. 1e-4: of the quadrature.
            checkRadiance(measure(scene, eye, kBlack, 0, 400000), expected, 1e-4);
        }
    }
}

TEST_CASE("screens let through what is not there, towards the eye and towards the lamp") {
    Scene scene;
    scene.images.push_back({"", 1, 1, {255, 255, 255, 153}}); // alpha 0.6
    addWall(scene, lambert(glm::vec3(0.6f)), -2.0f);
    const uint32_t lamp = addMaterial(scene, lambert(kBlack, glm::vec3(5.0f)));
    addQuad(scene, lamp, {-1.5f, -1, 0}, {0, 2, 0}, {3, 0, 0}); // 3 x 2, shines down
    const auto see = [&](LightStrategy strategy = LightStrategy::Mis) {
        return measure(scene, {2.0f, 0.0f, -1.5f}, {0, 0, -2}, 0, 400000, strategy);
    };
    const Vec3 open = see().mean;
    Material screen = lambert(kBlack);
    screen.alphaMode = AlphaMode::Blend;
    screen.alpha = 0.5f;
    screen.baseColorTexture.image = 0;
    const auto covered = static_cast<uint32_t>(scene.materials.size());
    addQuad(scene, addMaterial(scene, screen), {-9, -9, -1}, {18, 0, 0}, {0, 18, 0});
    addQuad(scene, covered, {-9, -9, -0.9f}, {18, 0, 0}, {0, 18, 0});
    // Two of coverage 0.3 between the lamp and the patch, and seen from above before the lamp.
    for (const auto strategy : {LightStrategy::Mis, LightStrategy::BsdfOnly, LightStrategy::LightOnly})
        checkRadiance(see(strategy), 0.49 * open, 0.008); // `open` has noise too: 4 sigma of 0.2 %
    checkRadiance(measure(scene, {0, 0, -1.8f}, kBlack, 0, 100000), 0.49 * 5.0);
    for (Vertex& v : scene.vertices) v.color.w = 0.5f; // and of 0.15
    checkRadiance(measure(scene, {0, 0, -1.8f}, kBlack, 0, 100000), 0.85 * 0.85 * 5.0);
    scene.materials[covered].alphaMode = AlphaMode::Mask;
    scene.materials[covered].alphaCutoff = 0.16f;
    CHECK(measure(scene, {0, 0, -1.8f}, kBlack, 0, 1600).mean.x == Approx(5.0));
    scene.materials[covered].alphaCutoff = 0.149f;
    CHECK(measure(scene, {0, 0, -1.8f}, kBlack, 0, 1600).mean.x == 0.0);
}

TEST_CASE("a half covered surface emits and scatters half") {
    Scene scene;
    Material half = lambert(glm::vec3(0.5f), glm::vec3(3.0f));
    half.alphaMode = AlphaMode::Blend;
    half.alpha = 0.4f;
    addWall(scene, half, 0.0f);
    scene.environment.constant = glm::vec3(2.0f);
    checkRadiance(measure(scene, eyeAt(0.5), kBlack, 0, 400000), 0.4 * (3.0 + 0.5 * 2.0) + 0.6 * 2.0);
}

TEST_CASE("vertices' colours are times the base colour, and times the emission of what is unlit") {
    Scene scene;
    addWall(scene, lambert({0.8f, 0.6f, 0.4f}), 0.0f);
    for (Vertex& v : scene.vertices) v.color = {0.5f, 0.25f, 1.0f, 0.1f};
    scene.environment.constant = glm::vec3(1.0f);
    checkRadiance(measure(scene, eyeAt(0.5), kBlack, 0, 100000), Vec3(0.4, 0.15, 0.4));
    Material& unlit = scene.materials[0];
    unlit = lambert(kBlack, {2.0f, 2.0f, 4.0f});
    checkRadiance(measure(scene, eyeAt(0.5), kBlack, 0, 64), Vec3(2.0, 2.0, 4.0));
    unlit.isUnlit = unlit.doubleSided = true;
    checkRadiance(measure(scene, {0, 0, -1}, kBlack, 0, 64), Vec3(1.0, 0.5, 4.0));
}

TEST_CASE("a picture is read where its transform puts it") {
    Scene scene;
    scene.images.push_back({"", 2, 2, {10, 0, 0, 255, 20, 0, 0, 255, 30, 0, 0, 255, 40, 0, 0, 255}});
    TextureRef texture{0, 0};
    texture.transform =
        glm::mat3x2(0.0f, 0.5f, -0.5f, 0.0f, 0.75f, 0.25f); // (u, v) -> (3/4 - v/2, 1/4 + u/2)
    const auto red = [&](double u, double v) {
        return 255.0 * sampleTexture(scene, texture, {u, v}, Encoding::Linear).x;
    };
    CHECK(red(0.0, 0.0) == Approx(20.0)); // at (3/4, 1/4): first row, second column
    CHECK(red(0.0, 1.0) == Approx(10.0));
    CHECK(red(1.0, 0.0) == Approx(40.0));
    CHECK(red(1.0, 1.0) == Approx(30.0));
}
