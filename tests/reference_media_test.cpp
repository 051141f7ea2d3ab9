// The reference path tracer through solid glass, against answers known in closed form.
#include "tests/reference/glass_scenes.h"
#include "tests/reference/measure.h"
#include "tests/support/check_radiance.h"
#include <catch2/catch_test_macros.hpp>

using namespace irradia;
using namespace irradia::reference;

namespace {

constexpr glm::vec3 kBlack(0.0f);

RenderSettings smallPicture(uint64_t seed, LightStrategy strategy = LightStrategy::Mis) {
    RenderSettings settings;
    settings.width = settings.height = 16;
    settings.seed = seed;
    settings.samples = 800;
    settings.maxBounces = 6;
    settings.strategy = strategy;
    return settings;
}

void checkSame(const ZTestResult& result) {
    CAPTURE(result.summary());
    CHECK(result.accepted());
    CHECK(std::abs(result.meanRatio - 1.0) < 4.0 * result.meanRatioSigma);
}

} // namespace

TEST_CASE("a path's solids as it enters, leaves and is reflected") {
    const Media none, a = none.entered(1), ab = a.entered(2);
    const auto is = [](const Media& m, int top, int below) { return m.top == top && m.below == below; };
    CHECK(is(a, 1, kNoMedium));
    CHECK(is(ab, 2, 1));
    CHECK(is(ab.left(2), 1, kNoMedium));
    CHECK(is(ab.left(1), 2, kNoMedium)); // out of the outer one first: overlapping solids
    CHECK(is(ab.left(3), 2, 1));
    CHECK(is(none.within(1), 1, kNoMedium)); // the camera was inside
    CHECK(is(ab.within(2), 2, 1));
    CHECK(is(ab.entered(3), 3, 2)); // the third is forgotten
}

TEST_CASE("an absorbing block of index 1 lets exp(-sigma d) through") {
    Scene scene;
    Material block = solidGlass(1.0f, 0.0f);
    block.absorption = {0.5f, 1.0f, 2.0f};
    addCuboid(scene, addMaterial(scene, block), {-1, -1, -1.5f}, {1, 1, 0});
    scene.environment.constant = glm::vec3(2.0f);
    const Measured seen = measure(scene, {0.1f, 0.2f, 1.0f}, {0.1f, 0.2f, -1.0f}, 8, 1600);
    // Indices are taken as 1e-4 apart, and microfacets tilt by 1e-3: ways are longer by 1e-6.
    checkRadiance(seen, 2.0 * glm::exp(-1.5 * Vec3(0.5, 1.0, 2.0)), 1e-5);
}

TEST_CASE("a slab of glass in a white furnace loses what it absorbs") {
    Scene scene;
    Material slab = solidGlass(1.5f, 0.0f);
    slab.absorption = {0.0f, 0.3f, 1.5f};
    addCuboid(scene, addMaterial(scene, slab), {-40, -40, -1}, {40, 40, 0});
    scene.environment.constant = glm::vec3(1.0f);
    // Along the normal F = 0.04: what is reflected between the two faces is a geometric series.
    Vec3 expected(0.0);
    for (int c = 0; c < 3; ++c) {
        const double f = 0.04, left = std::exp(-static_cast<double>(slab.absorption[c]));
        const double turns = 1.0 / (1.0 - f * f * left * left), through = (1.0 - f) * (1.0 - f) * left;
        expected[c] = through * turns * (1.0 + f * left) + f;
    }
    // Grazing microfacets lengthen the way, by the square of alpha.
    checkRadiance(measure(scene, {0, 0, 3}, kBlack, 30, 100000), expected, 1e-4);
}

TEST_CASE("light of a lamp in an absorbing medium is attenuated on its way") {
    // A lamp of 0.02 x 0.02 at height 1 over a patch, all in a block of index 1 that the camera looks into.
    Scene scene;
    addWall(scene, lambert(glm::vec3(0.6f)), 0.0f);
    Material block = solidGlass(1.0f, 0.0f);
    block.absorption = glm::vec3(0.7f);
    addCuboid(scene, addMaterial(scene, block), {-3, -3, -1}, {3, 3, 2});
    const uint32_t lamp = addMaterial(scene, lambert(kBlack, glm::vec3(5000.0f)));
    addQuad(scene, lamp, {0.49f, -0.01f, 1.0f}, {0, 0.02f, 0}, {0.02f, 0, 0}); // shines down
    const double distance2 = 1.0 + 0.25, cosine = 1.0 / std::sqrt(distance2);
    const double irradiance = 5000.0 * 0.02 * 0.02 * cosine * cosine / distance2;
    const double expected =
        0.6 / kPi * irradiance * std::exp(-0.7 * (std::sqrt(distance2) + 2.0)); // to the patch and to the eye
    for (const auto strategy : {LightStrategy::Mis, LightStrategy::LightOnly})
        checkRadiance(measure(scene, {0, 0, 4}, kBlack, 1, 20000, strategy), expected,
                      2e-4); // the lamp's size, squared
}

TEST_CASE("nested balls of white glass vanish in a white furnace, rough and smooth") {
    for (const float roughness : {0.0f, 0.3f, 0.8f}) {
        Scene scene;
        Material outer = solidGlass(1.33f, roughness);
        const uint32_t a = addMaterial(scene, outer), b = addMaterial(scene, solidGlass(1.8f, 0.5f));
        addSphere(scene, a, kBlack, 1.0f, 8, false);
        addSphere(scene, b, {0.1f, 0.0f, 0.1f}, 0.5f, 6, false);
        scene.environment.constant = glm::vec3(1.0f);
        const auto see = [&] { return measure(scene, {0.4f, 0.3f, 3.0f}, {0.1f, 0.05f, 0.0f}, 200, 100000); };
        // After 200 bounces less is left than 1e-3.
        checkRadiance(see(), 1.0, 1e-3);
        scene.materials[a].baseColor = glm::vec3(0.98f); // planted: twice 2 % at least
        const Measured planted = see();
        CHECK(planted.mean.x < 1.0 - 8.0 * planted.sigma.x - 1e-3);
    }
}

TEST_CASE("strategies, roulette and portals leave pictures of glass as they are; 3 % would be seen") {
    for (const Scene& scene : {roughSlab(), screens(), nestedBalls(), punctualRoom()}) {
        const PathTracer tracer(scene);
        const auto render = [&](const RenderSettings& settings) {
            return tracer.render(scene.cameras[0], settings);
        };
        const ImageEstimate plain = render(smallPicture(1));
        checkSame(zTest(render(smallPicture(2, LightStrategy::BsdfOnly)), plain));
        RenderSettings other = smallPicture(3);
        other.rouletteBounce = 0;
        other.portal = Portal{{-0.8, 0.99, -0.8}, {1.6, 0, 0}, {0, 0, 1.6}}; // the lamp
        ImageEstimate image = render(other);
        checkSame(zTest(image, plain));
        for (Vec3& mean : image.mean) mean *= 1.03; // planted
        const ZTestResult planted = zTest(image, plain);
        CAPTURE(planted.summary());
        CHECK(std::abs(planted.meanRatio - 1.0) > 4.0 * planted.meanRatioSigma);
    }
}
