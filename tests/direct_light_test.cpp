// Direct light at a point by light sampling, by BSDF sampling and by both, as the shaders estimate it,
// against double-precision quadrature.
#include "kernels/shaders.h"
#include "tests/reference/bsdf.h"
#include "tests/reference/environment_light.h"
#include "tests/reference/quadrature.h"
#include "tests/reference/simple_scenes.h"
#include "tests/support/bsdf_harness.h"
#include "tests/support/light_harness.h"
#include "tests/support/light_scenes.h"
#include <catch2/catch_test_macros.hpp>
#include <fmt/format.h>

using namespace irradia;
using reference::kPi;
using reference::Vec3;

namespace {

// The shaded point: the origin, normal +y, and the material of tests/shaders/lights_direct.comp.
const Vec3 kNormal(0, 1, 0);

struct Receiver {
    double metallic, roughness, degrees; // of the view direction from the normal

    reference::BsdfParameters material() const {
        return {Vec3(glm::vec3(0.8f, 0.6f, 0.4f)), metallic, roughness, Vec3(0.04), 1.0};
    }
    Vec3 view() const {
        return reference::Frame(kNormal).toWorld(reference::direction(std::cos(degrees / 180.0 * kPi), 0.0));
    }
    // f cos towards a world direction.
    Vec3 scattered(const reference::Bsdf& bsdf, const Vec3& direction) const {
        const reference::Frame frame(kNormal);
        const Vec3 l = frame.toLocal(direction);
        return bsdf.evaluate(frame.toLocal(view()), l) * std::max(l.z, 0.0);
    }
};

const reference::QuadratureRule& rule() {
    static const reference::QuadratureRule nodes = reference::gaussLegendre(48);
    return nodes;
}

// Integral of f cos over the solid angle of the scene's triangles; none hides another.
Vec3 scatteredFromTriangles(const Scene& scene, const Receiver& receiver) {
    const reference::Bsdf bsdf(receiver.material());
    Vec3 sum(0.0);
    for (const Triangle& t : scene.triangles) {
        const Vec3 p0(scene.vertices[t.vertex.x].position);
        const Vec3 e1 = Vec3(scene.vertices[t.vertex.y].position) - p0;
        const Vec3 e2 = Vec3(scene.vertices[t.vertex.z].position) - p0;
        sum += rule().integrate(0.0, 1.0, [&](double a) {
            return rule().integrate(0.0, 1.0, [&](double b) {
                const Vec3 p = p0 + a * ((1.0 - b) * e1 + b * e2);
                const double distance = glm::length(p);
                const double projectedArea = a * std::abs(glm::dot(glm::cross(e1, e2), p)) / distance;
                return receiver.scattered(bsdf, p / distance) * projectedArea / (distance * distance);
            });
        });
    }
    return sum;
}

// Integral of f cos L over the upper half of a picture, by halves of texels: there L is bilinear.
Vec3 scatteredFromPicture(const Environment& environment, const Receiver& receiver) {
    static const reference::QuadratureRule few = reference::gaussLegendre(6);
    const reference::EnvironmentLight light(environment);
    const reference::Bsdf bsdf(receiver.material());
    const double du = kPi / environment.width, dv = 0.5 * kPi / environment.height;
    Vec3 sum(0.0);
    for (int j = 0; j < environment.height; ++j)
        for (int i = 0; i < 2 * environment.width; ++i)
            sum += few.integrate(j * dv, (j + 1) * dv, [&](double polar) {
                return few.integrate(i * du - kPi, (i + 1) * du - kPi, [&](double azimuth) {
                    const Vec3 d(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                 std::sin(polar) * std::sin(azimuth));
                    return receiver.scattered(bsdf, d) * light.radiance(d) * std::sin(polar);
                });
            });
    return sum;
}

struct Estimate {
    Vec3 mean{0.0};
    Vec3 sigma{0.0}; // of the mean
};

enum Strategy { kLightSampling, kBsdfSampling, kBoth };

struct Estimates {
    Estimate of[3];
};

Estimates estimate(const Scene& scene, const Receiver& receiver,
                   const std::vector<Specialisation>& faults = {}) {
    const uint32_t items = 4096, samples = test::fullSweep() ? 1024 : 96;
    test::LightHarness harness(scene, kernels::lights_direct, faults);
    gpu::LightHarnessParams params{};
    params.normal = glm::vec4(glm::vec3(kNormal), receiver.roughness);
    params.view = glm::vec4(glm::vec3(receiver.view()), receiver.metallic);
    params.count = items;
    params.samples = samples;
    params.triangleCount = harness.triangles();
    const auto records = harness.run(params, 9, 3 * items, {test::reflectanceTable()});
    Estimates result;
    for (int s = 0; s < 3; ++s) {
        Vec3 sum(0.0), squares(0.0);
        for (uint32_t i = 0; i < items; ++i) {
            const Vec3 x = Vec3(test::toFloats(records[3 * i + s])) / double(samples);
            sum += x;
            squares += x * x;
        }
        const Vec3 mean = sum / double(items);
        result.of[s] = {mean, glm::sqrt((squares / double(items) - mean * mean) / double(items))};
    }
    return result;
}

// The estimate's deviation is above chance (4.5 sigma: once in 1e5) and above the table's error in the mend,
// 0.1 %.
bool isOff(const Estimate& e, const Vec3& expected) {
    for (int k = 0; k < 3; ++k)
        if (!(std::abs(e.mean[k] - expected[k]) <= 4.5 * e.sigma[k] + 1e-3 * expected[k])) return true;
    return false;
}

std::string text(const Estimate& e, const Vec3& expected) {
    return fmt::format("{:.5f} +- {:.5f}, expected {:.5f}", e.mean.x, e.sigma.x, expected.x);
}

const Receiver kReceivers[] = {{0.0, 0.5, 40.0}, {1.0, 0.4, 60.0}, {0.3, 1.0, 80.0}};
const glm::vec3 kEmission(3.0f, 2.0f, 1.0f);

// A lamp above the point, its front downwards, or any side.
Scene lamp(bool doubleSided, float height, float size) {
    Scene scene;
    Material material = reference::lambert(glm::vec3(0.0f), kEmission);
    material.doubleSided = doubleSided;
    const glm::vec3 corner(-0.4f * size, height, -0.6f * size), a(size, 0, 0), b(0, 0, size);
    const bool up = doubleSided; // then what is seen is the back
    reference::addQuad(scene, reference::addMaterial(scene, material), corner, up ? b : a, up ? a : b);
    return scene;
}

// The same as tiles in a slanted plane, fronts downwards.
Scene tiledLamp(int tiles) {
    Scene scene;
    const uint32_t material = reference::addMaterial(scene, reference::lambert(glm::vec3(0.0f), kEmission));
    const glm::vec3 a(0.5f, 0.2f, 0), b(0, 0, 0.5f);
    for (int i = 0; i < tiles; ++i)
        for (int j = 0; j < tiles; ++j)
            reference::addQuad(scene, material, glm::vec3(-0.7f, 0.4f, -0.9f) + float(i) * a + float(j) * b,
                               a, b);
    return scene;
}

void checkAll(const Scene& scene, const Receiver& receiver, const Vec3& expected,
              bool bsdfSamplingConverges = true) {
    const Estimates estimates = estimate(scene, receiver);
    for (const Strategy s : {kLightSampling, kBsdfSampling, kBoth}) {
        if (s == kBsdfSampling && !bsdfSamplingConverges) continue;
        INFO("strategy " << s << ", roughness " << receiver.roughness << ": "
                         << text(estimates.of[s], expected));
        CHECK(!isOff(estimates.of[s], expected));
    }
}

} // namespace

TEST_CASE("direct light of a lamp, small or near, seen from its front or its back") {
    for (const Receiver& receiver : kReceivers)
        for (const Scene& scene : {lamp(false, 2.0f, 0.5f), lamp(true, 1.0f, 1.5f), lamp(false, 0.2f, 2.0f)})
            checkAll(scene, receiver, Vec3(kEmission) * scatteredFromTriangles(scene, receiver));
    CHECK(test::validatedDevice().validationMessages() == 0);
}

TEST_CASE("direct light of a lamp of 32 triangles, chosen by their hierarchy") {
    for (const Receiver& receiver : kReceivers) {
        const Scene scene = tiledLamp(4);
        checkAll(scene, receiver, Vec3(kEmission) * scatteredFromTriangles(scene, receiver));
    }
}

TEST_CASE("direct light of a constant environment is its radiance times the albedo") {
    Scene scene;
    scene.environment.constant = glm::vec3(0.5f, 1.0f, 1.5f);
    for (const Receiver& receiver : kReceivers)
        checkAll(
            scene, receiver,
            Vec3(scene.environment.constant) *
                reference::directionalAlbedo(receiver.material(), std::cos(receiver.degrees / 180.0 * kPi)));
}

TEST_CASE("direct light of a sky with a strong sun") {
    Scene scene;
    scene.environment = test::skyWithSun(32, 16);
    for (const Receiver& receiver : kReceivers)
        checkAll(scene, receiver, scatteredFromPicture(scene.environment, receiver), false);
}

TEST_CASE("direct light of a lamp before an environment that it hides") {
    Scene scene = lamp(false, 1.0f, 1.0f);
    scene.environment.constant = glm::vec3(0.5f, 1.0f, 1.5f);
    const Vec3 sky(scene.environment.constant);
    for (const Receiver& receiver : kReceivers) {
        const Vec3 albedo =
            reference::directionalAlbedo(receiver.material(), std::cos(receiver.degrees / 180.0 * kPi));
        checkAll(scene, receiver,
                 sky * albedo + (Vec3(kEmission) - sky) * scatteredFromTriangles(scene, receiver));
    }
}

TEST_CASE("radiance off by 2 % or a light's density off by 5 % is found in the direct light") {
    const Scene scene = lamp(false, 2.0f, 0.5f);
    const Receiver& receiver = kReceivers[0];
    const Vec3 expected = Vec3(kEmission) * scatteredFromTriangles(scene, receiver);
    CHECK(isOff(estimate(scene, receiver, {test::floatConstant(test::kLightRadianceFault, 1.02f)}).of[kBoth],
                expected));
    CHECK(isOff(
        estimate(scene, receiver, {test::floatConstant(test::kLightPdfFault, 1.05f)}).of[kLightSampling],
        expected));
    CHECK(isOff(estimate(scene, receiver, {test::floatConstant(test::kLightPdfFault, 1.05f)}).of[kBoth],
                expected));
}
