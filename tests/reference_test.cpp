// The reference path tracer against answers known in closed form, and against itself.
#include "tests/reference/measure.h"
#include "tests/reference/texture.h"
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>

using namespace irradia;
using namespace irradia::reference;
using Catch::Approx;

namespace {

// Within `deviations` of its own noise, and the noise below half a percent of the value.
void checkRadiance(const Measured& measured, double expected, double deviations = 4.0) {
    CAPTURE(measured.mean.x, measured.sigma.x, expected);
    CHECK(measured.sigma.x < 0.005 * expected);
    CHECK(std::abs(measured.mean.x - expected) < deviations * measured.sigma.x + 1e-6 * expected);
}

// A picture of a bright sun on a dim sky.
Environment sunAndSky() {
    Environment environment;
    environment.width = 16, environment.height = 8;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            environment.texels.emplace_back(0.2f + 0.05f * static_cast<float>(x), 0.3f,
                                            0.1f * static_cast<float>(y));
    environment.texels[2 * 16 + 5] = {40.0f, 30.0f, 20.0f};
    return environment;
}

// The small box behind a wall with a hole, which lights the closed room of the camera.
Scene darkRoom() {
    Scene scene = smallBox();
    for (Material& material : scene.materials) material.roughness = std::max(material.roughness, 0.6f);
    const uint32_t wall = addMaterial(scene, lambert(glm::vec3(0.7f)));
    const auto add = [&](const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b) {
        addQuad(scene, wall, corner, a, b);
    };
    add({-1, -1, 1}, {0.6f, 0, 0}, {0, 2, 0}); // around the hole, x in [-0.4, 0.4] and y in [-0.9, -0.4]
    add({0.4f, -1, 1}, {0.6f, 0, 0}, {0, 2, 0});
    add({-0.4f, -1, 1}, {0.8f, 0, 0}, {0, 0.1f, 0});
    add({-0.4f, -0.4f, 1}, {0.8f, 0, 0}, {0, 1.4f, 0});
    add({-1, -0.3f, 1}, {2, 0, 0}, {0, 0, -0.6f}); // keeps the lamp's own light from it
    add({-1, -1, 3}, {2, 0, 0}, {0, 2, 0});        // the room, z in [1, 3]
    add({-1, -1, 1}, {2, 0, 0}, {0, 0, 2});
    add({-1, 1, 1}, {2, 0, 0}, {0, 0, 2});
    add({-1, -1, 1}, {0, 2, 0}, {0, 0, 2});
    add({1, -1, 1}, {0, 2, 0}, {0, 0, 2});
    scene.cameras[0] = lookAt({0.8f, 0.7f, 1.2f}, {-0.5f, -0.5f, 2.5f}, 1.2f);
    return scene;
}

} // namespace

TEST_CASE("a Lambert sphere of albedo 1/2 and emission 1/2 holds radiance 1") {
    Scene scene;
    addSphereFromInside(scene, addMaterial(scene, lambert(glm::vec3(0.5f), glm::vec3(0.5f))), glm::vec3(3.0f),
                        2.0f, 8);
    const glm::vec3 eye(3.2f, 2.9f, 3.5f), target(4.0f, 3.3f, 1.0f);
    checkRadiance(measure(scene, eye, target, 64, 40000), 1.0);
    // B bounces: the geometric series of B + 2 edges.
    for (const int bounces : {0, 1, 2, 3, 5})
        checkRadiance(measure(scene, eye, target, bounces, 40000), 1.0 - std::pow(0.5, bounces + 2.0));
}

TEST_CASE("two parallel planes, one of which glows: what each number of bounces reaches") {
    constexpr float kAlbedoBelow = 0.4f, kAlbedoAbove = 0.8f, kHalf = 1000.0f, kSize = 2.0f * kHalf;
    Scene scene;
    const uint32_t below = addMaterial(scene, lambert(glm::vec3(kAlbedoBelow), glm::vec3(3.0f)));
    const uint32_t above = addMaterial(scene, lambert(glm::vec3(kAlbedoAbove)));
    addQuad(scene, below, {-kHalf, 0, kHalf}, {kSize, 0, 0}, {0, 0, -kSize});
    addQuad(scene, above, {-kHalf, 1, -kHalf}, {kSize, 0, 0}, {0, 0, kSize});
    const glm::vec3 eye(0.0f, 0.5f, 0.0f);
    const auto lookDown = [&](int b) { return measure(scene, eye, {0.3f, 0.0f, 0.1f}, b, 200000); };
    const auto lookUp = [&](int b) { return measure(scene, eye, {0.3f, 1.0f, 0.1f}, b, 200000); };
    // Light escapes between the planes with a share of 1e-6: below the noise.
    const double once = 3.0 * kAlbedoAbove, twice = once * kAlbedoBelow, thrice = twice * kAlbedoAbove;
    checkRadiance(lookDown(0), 3.0);
    checkRadiance(lookDown(1), 3.0 + twice);
    checkRadiance(lookDown(2), 3.0 + twice);
    checkRadiance(lookUp(0), once);
    checkRadiance(lookUp(1), once);
    checkRadiance(lookUp(2), once + thrice);
}

TEST_CASE("under a constant sky an open plane shows its directional albedo") {
    const BsdfParameters glossy{{0.8, 0.8, 0.8}, 0.0, 0.5, Vec3(0.04), 1.0};
    Scene scene;
    Material material;
    material.baseColor = glm::vec3(0.8f);
    material.metallic = 0.0f;
    material.roughness = 0.5f;
    addQuad(scene, addMaterial(scene, material), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    scene.environment.constant = glm::vec3(2.5f);
    for (const double mu : {1.0, 0.5, 0.1}) {
        const glm::vec3 eye(static_cast<float>(std::sqrt(1.0 - mu * mu)), static_cast<float>(mu), 0.0f);
        checkRadiance(measure(scene, eye, glm::vec3(0.0f), 0, 200000), 2.5 * directionalAlbedo(glossy, mu).x);
        checkRadiance(measure(scene, {eye.x, -eye.y, eye.z}, glm::vec3(0.0f), 4, 200000),
                      2.5 * directionalAlbedo(glossy, mu).x); // the back scatters as the front does
    }
}

TEST_CASE("a patch under a quad receives the form factor") {
    // Differential area to a parallel rectangle with a corner above it, sides a and b over the distance
    // (Howell's catalogue of configuration factors, B-4); four of them make a centred rectangle.
    const double a = 0.75, b = 0.5;
    const auto term = [](double x, double y) {
        const double root = std::sqrt(1.0 + x * x);
        return x / root * std::atan(y / root);
    };
    const double formFactor = 4.0 * (term(a, b) + term(b, a)) / (2.0 * kPi);
    Scene scene;
    addQuad(scene, addMaterial(scene, lambert(glm::vec3(0.6f))), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    const uint32_t lamp = addMaterial(scene, lambert(glm::vec3(0.0f), glm::vec3(5.0f)));
    addQuad(scene, lamp, {-1.5f, 2, -1}, {3, 0, 0}, {0, 0, 2}); // 3 x 2 at height 2, shining down
    const glm::vec3 eye(2.0f, 0.5f, 0.0f);
    for (const auto strategy : {LightStrategy::Mis, LightStrategy::BsdfOnly, LightStrategy::LightOnly})
        checkRadiance(measure(scene, eye, glm::vec3(0.0f), 0, 400000, strategy), 0.6 * 5.0 * formFactor);
    scene.materials[lamp].doubleSided = true;
    checkRadiance(measure(scene, eye, glm::vec3(0.0f), 0, 400000), 0.6 * 5.0 * formFactor);
    // Turned away it shines on nothing unless it is double-sided, and its back blocks the sky.
    for (Triangle& t : scene.triangles)
        if (t.material == lamp) std::swap(t.vertex.y, t.vertex.z);
    checkRadiance(measure(scene, eye, glm::vec3(0.0f), 0, 400000), 0.6 * 5.0 * formFactor);
    scene.materials[lamp].doubleSided = false;
    CHECK(measure(scene, eye, glm::vec3(0.0f), 0, 400).mean.x == 0.0);
    scene.environment.constant = glm::vec3(1.0f);
    checkRadiance(measure(scene, eye, glm::vec3(0.0f), 0, 400000), 0.6 * (1.0 - formFactor));
}

TEST_CASE("every strategy of light sampling gives the same picture, and 2 % of radiance would be seen") {
    Scene scene = smallBox();
    // Smoother surfaces would give light sampling alone rare and huge values, whose variance is
    // underestimated.
    for (Material& material : scene.materials) material.roughness = std::max(material.roughness, 0.6f);
    scene.environment = sunAndSky(); // through the open side
    const PathTracer tracer(scene);
    const auto render = [&](uint64_t seed, int samples, LightStrategy strategy) {
        RenderSettings settings;
        settings.width = settings.height = 16;
        settings.maxBounces = 3;
        settings.samples = samples;
        settings.seed = seed;
        settings.strategy = strategy;
        return tracer.render(scene.cameras[0], settings);
    };
    const ImageEstimate mis = render(1, 2000, LightStrategy::Mis);
    const ZTestResult light = zTest(render(2, 2000, LightStrategy::LightOnly), mis);
    const ZTestResult chance =
        zTest(render(3, 4000, LightStrategy::BsdfOnly), mis); // noisier: lamps found by chance
    CAPTURE(light.summary(), chance.summary());
    CHECK(light.accepted());
    CHECK(chance.accepted());
    CHECK(std::abs(chance.meanRatio - 1.0) < 4.0 * chance.meanRatioSigma);

    ImageEstimate fault = render(4, 2000, LightStrategy::Mis);
    CHECK(zTest(fault, mis).accepted());
    for (Vec3& mean : fault.mean) mean *= 1.02;
    const ZTestResult planted = zTest(fault, mis);
    CAPTURE(planted.summary(), medianRelativeSigma(mis));
    CHECK_FALSE(planted.accepted());
}

TEST_CASE("a portal gives the same picture with less noise, and 10 % of its density would be seen") {
    const Scene scene = darkRoom();
    const PathTracer tracer(scene);
    const auto render = [&](uint64_t seed, const std::optional<Portal>& portal) {
        RenderSettings settings;
        settings.width = settings.height = 8;
        settings.maxBounces = 2;
        settings.samples = 16000;
        settings.seed = seed;
        settings.portal = portal;
        return tracer.render(scene.cameras[0], settings);
    };
    Portal hole{{-0.4, -0.9, 1.0}, {0.8, 0.0, 0.0}, {0.0, 0.5, 0.0}};
    const ImageEstimate without = render(1, std::nullopt), with = render(2, hole);
    const ZTestResult same = zTest(with, without);
    CAPTURE(same.summary(), medianRelativeSigma(with), medianRelativeSigma(without));
    CHECK(same.accepted());
    CHECK(std::abs(same.meanRatio - 1.0) < 4.0 * same.meanRatioSigma);
    CHECK(medianRelativeSigma(with) < 0.5 * medianRelativeSigma(without));

    hole.area *= 1.1;
    const ZTestResult planted = zTest(render(3, hole), with);
    CAPTURE(planted.summary());
    CHECK(std::abs(planted.meanRatio - 1.0) > 4.0 * planted.meanRatioSigma);
}

TEST_CASE("environment pictures are sampled by their density and read at texel centres") {
    const Environment picture = sunAndSky();
    const EnvironmentLight light(picture);
    Random random(1);
    double pdfIntegral = 0.0;
    Vec3 bySampling(0.0), uniformly(0.0);
    constexpr int kSamples = 400000;
    for (int i = 0; i < kSamples; ++i) {
        const Vec3 d = light.sample(random.uniform2());
        bySampling += light.radiance(d) / light.pdf(d) / static_cast<double>(kSamples);
        const Vec3 any = direction(1.0 - 2.0 * random.uniform(), 2.0 * kPi * random.uniform());
        uniformly += light.radiance(any) * 4.0 * kPi / static_cast<double>(kSamples);
        pdfIntegral += light.pdf(any) * 4.0 * kPi / kSamples;
    }
    CHECK(pdfIntegral == Approx(1.0).epsilon(0.02));
    CHECK(bySampling.x == Approx(uniformly.x).epsilon(0.03));
    // Texel (5, 2): u = 5.5 / 16, v = 2.5 / 8.
    const double azimuth = 2.0 * kPi * (5.5 / 16.0 - 0.5), polar = kPi * 2.5 / 8.0;
    const Vec3 sun(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));
    CHECK(light.radiance(sun).x == Approx(40.0));
    CHECK(light.radiance({0, 1, 1e-9}).z == Approx(0.0).margin(1e-6)); // first row = +Y
    CHECK(light.radiance({0, -1, 1e-9}).z == Approx(0.7));
}

TEST_CASE("textures are bilinear at texel centres, decoded before they are filtered, and wrapped by texel") {
    Scene scene;
    scene.images.push_back({"", 2, 1, {0, 0, 0, 255, 255, 255, 255, 0}});
    TextureRef texture{0, 0, Wrap::Repeat, Wrap::Repeat};
    const auto red = [&](double u, Encoding encoding = Encoding::Linear) {
        return sampleTexture(scene, texture, {u, 0.5}, encoding).x;
    };
    CHECK(red(0.25) == Approx(0.0));
    CHECK(red(0.75) == Approx(1.0));
    CHECK(red(0.5) == Approx(0.5));
    CHECK(red(0.5, Encoding::Srgb) == Approx(0.5)); // filtering first would give 0.214
    CHECK(red(0.0) == Approx(0.5));
    CHECK(red(-1.25) == Approx(1.0));
    texture.wrapS = Wrap::ClampToEdge;
    CHECK(red(0.0) == Approx(0.0));
    CHECK(red(7.0) == Approx(1.0));
    texture.wrapS = Wrap::MirroredRepeat;
    CHECK(red(1.0) == Approx(1.0));
    CHECK(red(1.75) == Approx(0.0));
    CHECK(red(-0.25) == Approx(0.0));
}

TEST_CASE("a normal map turns the normal about the tangent frame, on both sides") {
    Scene scene;
    Material material = lambert(glm::vec3(0.5f));
    material.normalTexture.image = 0;
    material.normalScale = 0.5f;
    scene.images.push_back({"", 1, 1, {255, 128, 255, 255}});                      // texel (1, 0.004, 1)
    addQuad(scene, addMaterial(scene, material), {0, 0, 0}, {1, 0, 0}, {0, 1, 0}); // front +z, tangent +x
    const TriangleShape shape = triangleShapes(scene)[0];
    const Hit hit{1.0, 0.3, 0.3, 0};
    const SurfacePoint front = surfaceAt(scene, shape, {{0.5, 0.3, 1}, {0, 0, -1}}, hit);
    const double y = 0.5 * (2.0 * 128.0 / 255.0 - 1.0);
    CHECK(glm::length(front.shading.normal - glm::normalize(Vec3(0.5, y, 1.0))) < 1e-12);
    const SurfacePoint back = surfaceAt(scene, shape, {{0.5, 0.3, -1}, {0, 0, 1}}, hit);
    CHECK(glm::length(back.shading.normal + front.shading.normal) < 1e-12);
    CHECK(back.geometricNormal.z == Approx(-1.0));
    const Vec3 grazing =
        glm::normalize(Vec3(1, 0, -0.1)); // seen from -x: the turned normal is lifted to the viewer
    const SurfacePoint lifted = surfaceAt(scene, shape, {{0, 0, 1}, grazing}, hit);
    CHECK(lifted.view.z == Approx(0.01).epsilon(0.2));
}

TEST_CASE("the hierarchy finds what a search of all triangles finds") {
    Random random(7);
    const auto vector = [&] { return Vec3(random.uniform(), random.uniform(), random.uniform()) - 0.5; };
    std::vector<TriangleShape> shapes;
    for (int i = 0; i < 500; ++i) shapes.push_back({4.0 * vector(), 1.5 * vector(), 1.5 * vector()});
    shapes.insert(shapes.end(), 40, shapes[0]); // equal centres
    const Bvh bvh(shapes);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Ray ray{5.0 * vector(), glm::normalize(vector())};
        double nearest = 1e300;
        for (const TriangleShape& t : shapes)
            if (const auto hit = Bvh({t}).closest(ray)) nearest = std::min(nearest, hit->distance);
        const auto hit = bvh.closest(ray);
        REQUIRE((hit ? hit->distance : 1e300) == nearest);
        REQUIRE(bvh.isOccluded(ray, 1.0) == (nearest < 1.0));
        hits += hit.has_value();
    }
    CHECK(hits > 500);
}

TEST_CASE("the picture is upright and not mirrored, and does not depend on threads") {
    Scene scene = smallBox();
    RenderSettings settings;
    settings.width = 24, settings.height = 16;
    settings.samples = 16;
    const PathTracer tracer(scene);
    const ImageEstimate image = tracer.render(scene.cameras[0], settings);
    const auto at = [&](int x, int y) { return image.mean[static_cast<size_t>(y) * 24 + x]; };
    CHECK(at(5, 8).x > 3.0 * at(5, 8).y);   // the red wall on the left
    CHECK(at(18, 8).y > 1.5 * at(18, 8).x); // the green one on the right
    CHECK(at(12, 2).x > 5.0);               // the lamp above
    settings.threads = 1;
    CHECK(tracer.render(scene.cameras[0], settings).mean == image.mean);
}
