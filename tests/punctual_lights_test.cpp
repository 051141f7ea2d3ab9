// Lights without extent in the light sampler: what is chosen how often beside triangles and an environment,
// the chances claimed, and their records.
#include "engine/scene/lights/packed_lights.h"
#include "tests/reference/lights.h"
#include "tests/reference/statistics.h"
#include "tests/support/light_draws.h"
#include "tests/support/light_scenes.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <numeric>

using namespace irradia;
using namespace irradia::test;
using reference::Vec3;
using Kind = PunctualLight::Kind;

namespace {

const double kLevel = reference::sidakLevel(0.01, 16); // of each test of distribution
constexpr uint32_t kSamples = 1u << 20;

std::vector<PunctualLight> ofKind(const Scene& scene, bool directional) {
    std::vector<PunctualLight> lights;
    for (const PunctualLight& light : scene.lights)
        if ((light.kind == Kind::Directional) == directional && light.intensity != glm::vec3(0.0f))
            lights.push_back(light);
    return lights;
}

double power(const PunctualLight& light) {
    return reference::luminance(Vec3(light.intensity));
}

double power(const Scene& scene, const Triangle& t) {
    const Vec3 p0(scene.vertices[t.vertex.x].position), p1(scene.vertices[t.vertex.y].position);
    const Material& m = scene.materials[t.material];
    const double area =
        0.5 * glm::length(glm::cross(p1 - p0, Vec3(scene.vertices[t.vertex.z].position) - p0));
    return area * reference::luminance(Vec3(m.emission)) * (m.doubleSided ? 2.0 : 1.0);
}

// The lights of a scene under a sky, and the chance of each: triangles, points and spots, directional lights,
// the environment.
struct Expected {
    explicit Expected(const Scene& scene)
        : triangles(scene.triangles.size())
        , local(ofKind(scene, false))
        , directional(ofKind(scene, true)) {
        std::vector<double> powers;
        for (const Triangle& t : scene.triangles) powers.push_back(power(scene, t));
        for (const PunctualLight& light : local) powers.push_back(power(light));
        add(powers);
        powers.clear();
        for (const PunctualLight& light : directional) powers.push_back(power(light));
        add(powers);
        if (!scene.environment.isBlack()) add({1.0});
        for (double& chance : chances) chance /= groups;
    }

    void add(const std::vector<double>& powers) {
        const double total = std::accumulate(powers.begin(), powers.end(), 0.0);
        if (!powers.empty()) ++groups;
        for (const double p : powers) chances.push_back(p / total);
    }

    // Triangles are known by their blue, points and spots by their place, directional lights by where they
    // are.
    size_t lightOf(const LightDraw& draw, const glm::vec3& origin) const {
        if (draw.isEnvironment()) return chances.size() - 1;
        if (!draw.isPunctual) return static_cast<size_t>(std::lround(draw.radiance.b)) - 1;
        const auto distance = [&](const PunctualLight& light) {
            const bool isFar = light.kind == Kind::Directional;
            return glm::length(isFar ? Vec3(light.direction) + draw.direction
                                     : Vec3(light.position) - Vec3(origin) -
                                           double(draw.tMax) * draw.direction);
        };
        const std::vector<PunctualLight>& lights = draw.isFarAway() ? directional : local;
        const auto nearest = std::ranges::min_element(lights, {}, distance);
        REQUIRE(distance(*nearest) < 1e-5);
        return triangles + (draw.isFarAway() ? local.size() : 0) +
               static_cast<size_t>(nearest - lights.begin());
    }

    size_t triangles;
    std::vector<PunctualLight> local, directional;
    std::vector<double> chances;
    double groups = 0.0;
};

void checkChoices(const Scene& scene, uint32_t sampler) {
    const glm::vec3 origin(0.0f);
    const Expected expected(scene);
    std::vector<double> counts(expected.chances.size()), means = expected.chances;
    double worst = 0.0;
    for (const LightDraw& draw : drawLights(scene, origin, kSamples, Rays::None, sampler)) {
        const size_t light = expected.lightOf(draw, origin);
        counts.at(light) += 1.0;
        if (draw.isPunctual) worst = std::max(worst, std::abs(draw.pdf / expected.chances[light] - 1.0));
    }
    CHECK(worst < 1e-5); // the chance that is claimed
    for (double& mean : means) mean *= kSamples;
    CHECK(reference::chiSquareTest(counts, means).pValue > kLevel);
    for (size_t i = 0; i < means.size(); i += 2) means[i] *= 1.05; // planted
    if (means.size() > 1) CHECK(reference::chiSquareTest(counts, means).pValue < 1e-6);
}

} // namespace

TEST_CASE("few lights of all kinds are chosen by power, and groups of them alike") {
    const uint32_t sampler = GENERATE(from_range(std::begin(kSamplers), std::end(kSamplers)));
    Scene lamps;
    addPunctualLights(lamps, 3, 3, 0); // one of them is off
    checkChoices(lamps, sampler);
    Scene suns;
    addPunctualLights(suns, 0, 0, 8);
    checkChoices(suns, sampler);
    Scene all = manyEmitters(2);
    addPunctualLights(all, 3, 3, 8);
    checkChoices(all, sampler);
    all.environment.constant = glm::vec3(0.5f);
    checkChoices(all, sampler);
    Scene alone;
    addPunctualLights(alone, 1, 0, 0);
    checkChoices(alone, sampler);
    CHECK(validatedDevice().validationMessages() == 0);
}

TEST_CASE("many lights of all kinds are chosen as their hierarchy's twin says") {
    Scene scene = manyEmitters(150);
    addPunctualLights(scene, 150, 150, 5);
    std::erase_if(scene.lights,
                  [](const PunctualLight& light) { return light.intensity == glm::vec3(0.0f); });
    const uint32_t sampler = GENERATE(from_range(std::begin(kSamplers), std::end(kSamplers)));
    for (const glm::vec3& point :
         {glm::vec3(0.0f), glm::vec3(1.2f, 0.1f, -0.2f), glm::vec3(-7.0f, 3.0f, 2.0f)}) {
        const ChoiceAgreement found = compareChoices(scene, point, kSamples, sampler);
        INFO("from " << point.x << ": chances off by " << found.worst << ", found ones by "
                     << found.worstFound);
        CHECK(found.worst < kConeRounding);
        CHECK(found.worstFound < 1e-5); // rounding of some ten factors
        CHECK(found.bins > 20);
        CHECK(found.pValue > kLevel);
        CHECK(found.plantedPValue < 1e-6);
    }
}
