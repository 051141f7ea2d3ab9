// Light sampling in the shaders: what is chosen how often, the densities it claims, and direct light by it.
#include "engine/scene/lights/packed_lights.h"
#include "tests/reference/lights.h"
#include "tests/reference/statistics.h"
#include "tests/support/light_chances.h"
#include "tests/support/light_draws.h"
#include "tests/support/light_scenes.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <cmath>

using namespace irradia;
using reference::kPi;
using reference::Vec3;
using test::drawLights;
using test::kConeRounding;
using test::kReceiverNormal;
using test::kSamplers;
using test::LightDraw;
using test::Rays;
using test::treeOf;

namespace {

const double kLevel = reference::sidakLevel(0.01, 10); // of each test of distribution
struct Agreement {
    double seen = 0.0;     // share of samples whose ray meets the sampled point and nothing before it
    double agreeing = 0.0; // share of these whose density is the one that the ray finds and the reference's
};

Agreement compareDensities(const Scene& scene, const glm::vec3& origin) {
    const reference::Lights lights(scene);
    const std::vector<LightDraw> samples = drawLights(scene, origin, 50000, Rays::Cast);
    const bool isConstant = scene.environment.texels.empty(); // the reference samples it another way
    const bool hasTree = scene.triangles.size() >= kLightTreeFrom;
    const std::vector<double> chances =
        hasTree ? test::lightChances(treeOf(scene), {Vec3(origin), kReceiverNormal}) : std::vector<double>{};
    // Rounding in distances and in cosines down to 0.1.
    const double tolerance = hasTree ? kConeRounding : 1e-4;
    double seen = 0.0, agreeing = 0.0;
    for (const LightDraw& s : samples) {
        REQUIRE((s.pdf > 0.0 && std::abs(glm::length(s.direction) - 1.0) < 1e-6));
        if (!s.isEnvironment() && std::abs(s.hitDistance - s.tMax) > 1e-3 * s.tMax) continue;
        ++seen;
        double exact = s.pdf;
        if (!s.isEnvironment())
            exact = hasTree ? lights.trianglePdf(s.hitPrimitive, s.direction, s.hitDistance,
                                                 chances[s.hitPrimitive])
                            : lights.trianglePdf(s.hitPrimitive, s.direction, s.hitDistance);
        else if (!isConstant)
            exact = lights.environmentPdf(s.direction);
        if (std::abs(s.hitPdf - s.pdf) <= 1e-4 * s.pdf && std::abs(exact - s.pdf) <= tolerance * s.pdf)
            ++agreeing;
    }
    return {seen / double(samples.size()), agreeing / seen};
}

// Luminance of bilinear radiance at (u, v), in texels.
double pictureLuminance(const Environment& e, double x, double y) {
    const auto texel = [&](int i, int j) {
        const int row = std::clamp(j, 0, e.height - 1), column = (i % e.width + e.width) % e.width;
        return reference::luminance(Vec3(e.texels[static_cast<size_t>(row * e.width + column)]));
    };
    const double cx = x - 0.5, cy = y - 0.5, x0 = std::floor(cx), y0 = std::floor(cy), fx = cx - x0,
                 fy = cy - y0;
    const int i = static_cast<int>(x0), j = static_cast<int>(y0);
    return (1 - fy) * ((1 - fx) * texel(i, j) + fx * texel(i + 1, j)) +
           fy * ((1 - fx) * texel(i, j + 1) + fx * texel(i + 1, j + 1));
}

// Mean luminance over a texel by the midpoint rule (exact for bilinear pieces with an even number of points).
double meanLuminance(const Environment& e, int x, int y) {
    constexpr int kPoints = 4;
    double sum = 0.0;
    for (int j = 0; j < kPoints; ++j)
        for (int i = 0; i < kPoints; ++i)
            sum += pictureLuminance(e, x + (i + 0.5) / kPoints, y + (j + 0.5) / kPoints);
    return sum / (kPoints * kPoints);
}

} // namespace

TEST_CASE("few emitters are chosen by power") {
    constexpr uint32_t kCount = kLightTreeFrom - 1;
    const Scene scene = test::manyEmitters(kCount);
    constexpr uint32_t kSamples = 1u << 20;
    std::vector<double> counts(kCount), expected(kCount);
    const uint32_t sampler = GENERATE(from_range(std::begin(kSamplers), std::end(kSamplers)));
    // An emitter is known by its blue; the back of one-sided ones, which is black, faces away from the
    // origin.
    for (const LightDraw& s : drawLights(scene, glm::vec3(0.0f), kSamples, Rays::None, sampler))
        counts.at(static_cast<size_t>(std::lround(s.radiance.b)) - 1) += 1.0;
    double total = 0.0;
    for (size_t i = 0; i < kCount; ++i) {
        const Material& m = scene.materials[i];
        const Vec3 p0(scene.vertices[3 * i].position), p1(scene.vertices[3 * i + 1].position);
        const Vec3 p2(scene.vertices[3 * i + 2].position);
        expected[i] = glm::length(glm::cross(p1 - p0, p2 - p0)) * reference::luminance(Vec3(m.emission)) *
                      (m.doubleSided ? 2.0 : 1.0);
        total += expected[i];
    }
    for (double& e : expected) e *= kSamples / total;
    CHECK(reference::chiSquareTest(counts, expected).pValue > kLevel);
    for (size_t i = 0; i < kCount; i += 2) expected[i] *= 1.05; // planted
    CHECK(reference::chiSquareTest(counts, expected).pValue < 1e-6);
}

TEST_CASE("many emitters are chosen as their hierarchy's twin says") {
    const Scene scene = test::manyEmitters(500);
    constexpr uint32_t kSamples = 1u << 20;
    const uint32_t sampler = GENERATE(from_range(std::begin(kSamplers), std::end(kSamplers)));
    // From the first point all lights lie 2 away; from the second and the third some show their backs.
    for (const glm::vec3& point :
         {glm::vec3(0.0f), glm::vec3(1.9f, 0.1f, -0.2f), glm::vec3(-7.0f, 3.0f, 2.0f)}) {
        const test::ChoiceAgreement found = test::compareChoices(scene, point, kSamples, sampler);
        INFO("from " << point.x << ": chances off by " << found.worst << ", found ones by "
                     << found.worstFound);
        CHECK(found.worst < kConeRounding);
        CHECK(found.worstFound < 1e-5); // rounding of some ten factors
        CHECK(found.bins > 20);
        CHECK(found.pValue > kLevel);
        CHECK(found.plantedPValue < 1e-6);
    }
}

TEST_CASE("environment texels are chosen by luminance and solid angle, and points in them uniformly") {
    Scene scene;
    scene.environment = test::skyWithSun(16, 8);
    const Environment& sky = scene.environment;
    constexpr uint32_t kSamples = 1u << 20;
    const uint32_t sampler = GENERATE(from_range(std::begin(kSamplers), std::end(kSamplers)));
    constexpr int kParts = 4; // of a texel's side
    const size_t bins = sky.texels.size() * kParts * kParts;
    std::vector<double> counts(bins), expected(bins);
    const auto binOf = [&](int x, int y) { return static_cast<size_t>(y) * 16 * kParts + x; };
    for (const LightDraw& s : drawLights(scene, glm::vec3(0.0f), kSamples, Rays::None, sampler)) {
        const double u = std::atan2(s.direction.z, s.direction.x) / (2.0 * kPi) + 0.5;
        const double v = std::acos(s.direction.y) / kPi;
        counts[binOf(std::clamp(int(u * 16 * kParts), 0, 16 * kParts - 1),
                     std::clamp(int(v * 8 * kParts), 0, 8 * kParts - 1))] += 1.0;
    }
    double total = 0.0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            const double solidAngle = std::cos(kPi * y / 8) - std::cos(kPi * (y + 1) / 8);
            const double mass = meanLuminance(sky, x, y) * solidAngle;
            total += mass;
            for (int k = 0; k < kParts * kParts; ++k)
                expected[binOf(x * kParts + k % kParts, y * kParts + k / kParts)] = mass / (kParts * kParts);
        }
    for (double& e : expected) e *= kSamples / total;
    CHECK(reference::chiSquareTest(counts, expected).pValue > kLevel);
    for (size_t i = 0; i < bins; i += 2) expected[i] *= 1.05; // planted
    CHECK(reference::chiSquareTest(counts, expected).pValue < 1e-6);
}

TEST_CASE("a light sample's density is the one that a ray in its direction finds") {
    const glm::vec3 origin(0.3f, -0.2f, 0.1f);
    const auto checkScene = [&](const Scene& scene) {
        const Agreement agreement = compareDensities(scene, origin);
        INFO("seen " << agreement.seen << ", agreeing " << agreement.agreeing);
        CHECK(agreement.seen > 0.9);
        CHECK(agreement.agreeing > 0.9995); // all but directions that rounding puts into a neighbouring texel
    };
    checkScene(test::manyEmitters(24));
    Scene scene = test::manyEmitters(kLightTreeFrom - 1);
    checkScene(scene);
    scene.environment.constant = glm::vec3(0.5f, 0.6f, 0.7f);
    checkScene(scene);
    scene.environment = test::skyWithSun(32, 16);
    checkScene(scene);
    Scene sky;
    sky.environment = scene.environment;
    checkScene(sky);
    CHECK(test::validatedDevice().validationMessages() == 0);
}
