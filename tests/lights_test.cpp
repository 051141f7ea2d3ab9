// Light sampling in the shaders: what is chosen how often, the densities it claims, and direct light by it.
#include "engine/scene/lights/light_tree.h"
#include "engine/scene/lights/packed_lights.h"
#include "kernels/shaders.h"
#include "tests/reference/lights.h"
#include "tests/reference/statistics.h"
#include "tests/support/light_chances.h"
#include "tests/support/light_harness.h"
#include "tests/support/light_scenes.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <cmath>
#include <numeric>

using namespace irradia;
using reference::kPi;
using reference::Vec3;
using test::toFloats;

namespace {

constexpr float kFarAway = 1e30f;
const Vec3 kNormal = glm::normalize(Vec3(0.2, 0.9, -0.4)); // of the receiver
const double kLevel = reference::sidakLevel(0.01, 10);     // of each test of distribution
// With Sobol' points one number makes a chain of choices, with random ones each has its own.
constexpr uint32_t kSamplers[] = {gpu::kSamplerRandom, gpu::kSamplerSobol};
constexpr double kConeRounding = 0.01; // of octahedral axes, some 1e-4: it shows where a cone just ends

struct Sample {
    Vec3 direction;
    float tMax;
    glm::vec3 radiance;
    double pdf;
    double hitPdf; // that a ray in the direction finds
    double hitDistance;
    uint32_t hitPrimitive;

    bool isEnvironment() const { return tMax == kFarAway; }
};

enum class Rays { Cast, None };

std::vector<Sample> drawLights(const Scene& scene, const glm::vec3& origin, uint32_t count, Rays rays,
                               uint32_t sampler = gpu::kSamplerRandom) {
    test::LightHarness harness(scene, kernels::lights_sample, {{gpu::kConstantSampler, sampler}});
    gpu::LightHarnessParams params{};
    params.origin = glm::vec4(origin, 0.0f);
    params.normal = glm::vec4(glm::vec3(kNormal), 0.0f);
    params.count = count;
    params.triangleCount = rays == Rays::Cast ? harness.triangles() : 0;
    const auto records = harness.run(params, 5, 3 * size_t(count));
    std::vector<Sample> samples;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec4 r0 = toFloats(records[3 * i]), r1 = toFloats(records[3 * i + 1]);
        const glm::vec4 r2 = toFloats(records[3 * i + 2]);
        samples.push_back({Vec3(r0), r0.w, glm::vec3(r1), r1.w, r2.x, r2.y, records[3 * i + 2].z});
    }
    return samples;
}

// The hierarchy of a scene all of whose triangles emit.
LightTree treeOf(const Scene& scene) {
    std::vector<TreeLight> lights;
    for (const Triangle& t : scene.triangles) {
        const Material& m = scene.materials[t.material];
        TreeLight light;
        for (int k = 0; k < 3; ++k) light.corners[k] = Vec3(scene.vertices[t.vertex[k]].position);
        const auto& [a, b, c] = light.corners;
        light.isTwoSided = m.doubleSided;
        light.power = 0.5 * glm::length(glm::cross(b - a, c - a)) * reference::luminance(Vec3(m.emission)) *
                      (m.doubleSided ? 2.0 : 1.0);
        lights.push_back(light);
    }
    return buildLightTree(lights);
}

struct Agreement {
    double seen = 0.0;     // share of samples whose ray meets the sampled point and nothing before it
    double agreeing = 0.0; // share of these whose density is the one that the ray finds and the reference's
};

Agreement compareDensities(const Scene& scene, const glm::vec3& origin) {
    const reference::Lights lights(scene);
    const std::vector<Sample> samples = drawLights(scene, origin, 50000, Rays::Cast);
    const bool isConstant = scene.environment.texels.empty(); // the reference samples it another way
    const bool hasTree = scene.triangles.size() >= kLightTreeFrom;
    const std::vector<double> chances =
        hasTree ? test::lightChances(treeOf(scene), {Vec3(origin), kNormal}) : std::vector<double>{};
    // Rounding in distances and in cosines down to 0.1.
    const double tolerance = hasTree ? kConeRounding : 1e-4;
    double seen = 0.0, agreeing = 0.0;
    for (const Sample& s : samples) {
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

struct Choice {
    uint32_t light;
    double chance; // with which it was chosen, 0 = none
    double found;  // that a ray which meets it finds
};

std::vector<Choice> chooseLights(const Scene& scene, const glm::vec3& point, uint32_t count,
                                 uint32_t sampler) {
    test::LightHarness harness(scene, kernels::lights_choose, {{gpu::kConstantSampler, sampler}});
    gpu::LightHarnessParams params{};
    params.origin = glm::vec4(point, 0.0f);
    params.normal = glm::vec4(glm::vec3(kNormal), 0.0f);
    params.count = count;
    std::vector<Choice> choices;
    for (const glm::uvec4& record : harness.run(params, 6, count))
        choices.push_back({record.x, toFloats(record).y, toFloats(record).z});
    return choices;
}

// The bins expected to hold fewer than 100 become one.
void lumpRare(std::vector<double>& counts, std::vector<double>& expected) {
    std::vector<double> c(1), e(1);
    for (size_t i = 0; i < counts.size(); ++i) {
        const bool isRare = expected[i] < 100.0;
        if (isRare)
            c[0] += counts[i], e[0] += expected[i];
        else
            c.push_back(counts[i]), e.push_back(expected[i]);
    }
    counts = c, expected = e;
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
    for (const Sample& s : drawLights(scene, glm::vec3(0.0f), kSamples, Rays::None, sampler))
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
        const std::vector<double> chances = test::lightChances(treeOf(scene), {Vec3(point), kNormal});
        std::vector<double> counts(501), expected(501); // the last: the way down met no light
        double worst = 0.0, worstFound = 0.0;
        for (const Choice& c : chooseLights(scene, point, kSamples, sampler)) {
            counts[c.chance > 0.0 ? c.light : 500] += 1.0;
            if (c.chance == 0.0) continue;
            worst = std::max(worst, std::abs(c.chance - chances[c.light]) / (chances[c.light] + 1e-4));
            worstFound = std::max(worstFound, std::abs(c.found / c.chance - 1.0));
        }
        INFO("from " << point.x << ": chances off by " << worst << ", found ones by " << worstFound);
        CHECK(worst < kConeRounding);
        CHECK(worstFound < 1e-5); // rounding of some ten factors
        for (size_t i = 0; i < 500; ++i) expected[i] = kSamples * chances[i];
        expected[500] = kSamples * std::max(1.0 - std::accumulate(chances.begin(), chances.end(), 0.0), 0.0);
        lumpRare(counts, expected);
        CHECK(counts.size() > 20);
        CHECK(reference::chiSquareTest(counts, expected).pValue > kLevel);
        for (size_t i = 0; i < counts.size(); i += 2) expected[i] *= 1.05; // planted
        CHECK(reference::chiSquareTest(counts, expected).pValue < 1e-6);
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
    for (const Sample& s : drawLights(scene, glm::vec3(0.0f), kSamples, Rays::None, sampler)) {
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
