// The reference's lamps without extent (KHR_lights_punctual), against answers known in closed form.
#include "tests/reference/glass_scenes.h"
#include "tests/reference/measure.h"
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>

using namespace irradia;
using namespace irradia::reference;
using Catch::Approx;

namespace {

constexpr glm::vec3 kBlack(0.0f);

// A square of side 2 in the plane z, its front towards +z.
void addWall(Scene& scene, const Material& material, float z) {
    addQuad(scene, addMaterial(scene, material), {-1, -1, z}, {2, 0, 0}, {0, 2, 0});
}

// From a unit above the origin of a wall, at cosine mu to it.
glm::vec3 eyeAt(double mu) {
    return {static_cast<float>(std::sqrt(1.0 - mu * mu)), 0.0f, static_cast<float>(mu)};
}

// A patch of albedo 0.6 at the origin that faces up, and what shines on it.
Scene litPatch(const PunctualLight& light) {
    Scene scene;
    addWall(scene, lambert(glm::vec3(0.6f)), 0.0f);
    scene.lights.push_back(light);
    return scene;
}

Vec3 seenOnPatch(const Scene& scene, LightStrategy strategy = LightStrategy::Mis) {
    const Measured seen = measure(scene, eyeAt(0.5), kBlack, 0, 64, strategy);
    CHECK(seen.sigma.x <= 1e-5 * seen.mean.x); // one light: no noise but the pinhole's width
    return seen.mean;
}

} // namespace

TEST_CASE("lamps without extent light a plane as KHR_lights_punctual says") {
    using Kind = PunctualLight::Kind;
    PunctualLight point{"", Kind::Point, {0.0f, 1.5f, 2.0f}};
    point.intensity = {7.0f, 5.0f, 3.0f};
    const double distance = 2.5, cosine = 0.8;
    const Vec3 expected = 0.6 / kPi * cosine / (distance * distance) * Vec3(point.intensity);
    Scene scene = litPatch(point);
    const auto check = [&](double factor) {
        for (const auto strategy : {LightStrategy::Mis, LightStrategy::BsdfOnly, LightStrategy::LightOnly}) {
            const Vec3 seen = seenOnPatch(scene, strategy);
            // Intensities and angles are single precision; the pinhole is 1e-4 wide.
            CHECK(glm::length(seen - factor * expected) <= 2e-5 * glm::length(expected));
        }
    };
    check(1.0);
    scene.lights[0].range = 5.0f;
    check(1.0 - 0.0625);
    scene.lights[0].range = 2.4f;
    check(0.0);

    PunctualLight& spot = scene.lights[0] = point;
    spot.kind = Kind::Spot;
    const double axis = std::atan2(1.5, 2.0); // towards the patch; turned by 0.3 from there
    spot.direction = {0.0f, static_cast<float>(-std::sin(axis + 0.3)),
                      static_cast<float>(-std::cos(axis + 0.3))};
    spot.innerAngle = 0.35f, spot.outerAngle = 0.5f;
    check(1.0);
    spot.innerAngle = 0.1f, spot.outerAngle = 0.25f;
    check(0.0);
    spot.innerAngle = 0.2f, spot.outerAngle = 0.4f;
    const double linear = (std::cos(0.3) - std::cos(0.4)) / (std::cos(0.2) - std::cos(0.4));
    check(linear * linear);

    PunctualLight& sun = scene.lights[0] = point;
    sun.kind = Kind::Directional;
    sun.direction = {0.0f, -0.6f, -0.8f};
    check(distance * distance);
    // A screen of coverage 0.3 on the way, for each; then a wall.
    Material screen = lambert(kBlack);
    screen.alphaMode = AlphaMode::Blend;
    screen.alpha = 0.3f;
    addQuad(scene, addMaterial(scene, screen), {-1, 0.5f, 1}, {2, 0, 0}, {0, 1, 0});
    check(0.7 * distance * distance);
    scene.lights[0] = point;
    check(0.7);
    scene.materials.back().alpha = 1.0f;
    check(0.0);
}

TEST_CASE("of many lamps one is chosen without bias, and an error of 2 % would be seen") {
    using Kind = PunctualLight::Kind;
    Scene scene = litPatch({"", Kind::Directional, kBlack, {0, 0, -1}, glm::vec3(1.0f)});
    double irradiance = 1.0;
    for (int i = 0; i < 7; ++i) {
        const float side = 0.3f * static_cast<float>(i);
        scene.lights.push_back({"", Kind::Point, {side, 0, 1}, {0, 0, -1}, glm::vec3(0.5f + side)});
        const double d2 = 1.0 + static_cast<double>(side) * static_cast<double>(side);
        irradiance += (0.5 + static_cast<double>(side)) / (d2 * std::sqrt(d2));
    }
    const Measured seen = measure(scene, eyeAt(0.5), kBlack, 0, 200000);
    CHECK(std::abs(seen.mean.x - 0.6 / kPi * irradiance) < 4.0 * seen.sigma.x);
    CHECK(std::abs(1.02 * seen.mean.x - 0.6 / kPi * irradiance) > 8.0 * seen.sigma.x); // planted
}

TEST_CASE("smooth surfaces do not show lamps without extent, rough ones do") {
    using Kind = PunctualLight::Kind;
    Scene scene = litPatch({"", Kind::Point, {0, 0, 2}, {0, 0, -1}, glm::vec3(4.0f)});
    Material& mirror = scene.materials[0];
    mirror = Material{};
    mirror.roughness = 0.0f;
    CHECK(seenOnPatch(scene).x == 0.0);
    mirror.roughness = 0.5f;
    const Vec3 v = direction(0.5, 0.0), l(0, 0, 1);
    const Bsdf metal({Vec3(1.0), 1.0, 0.5, Vec3(0.04), 1.0});
    CHECK(seenOnPatch(scene).x == Approx(metal.evaluate(v, l).x).epsilon(1e-5));
    mirror.metallic = 0.0f; // a polished dielectric shows them by its Lambert lobe alone
    mirror.roughness = 0.0f;
    const Bsdf polished({Vec3(1.0), 0.0, 0.0, Vec3(0.04), 1.0});
    CHECK(seenOnPatch(scene).x == Approx(polished.evaluate(v, l, Lobes::Diffuse).x).epsilon(1e-5));
    // A rough sheet shows a lamp behind it.
    mirror = glassSheet(0.5f);
    scene.lights[0].position.z = -2.0f;
    const Glass sheet({Vec3(1.0), 0.0, 0.5, Vec3(0.04), 1.0}, {GlassParameters::Kind::RoughSheet, 1.0});
    CHECK(seenOnPatch(scene).x == Approx(sheet.evaluate(v, -l).x).epsilon(1e-5));
}
