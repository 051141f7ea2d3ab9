#include "tests/support/light_draws.h"

#include "kernels/shaders.h"
#include "tests/reference/statistics.h"
#include "tests/support/light_chances.h"
#include <cmath>
#include <numeric>

namespace irradia::test {

using reference::Vec3;

const Vec3 kReceiverNormal = glm::normalize(Vec3(0.2, 0.9, -0.4));

std::vector<LightDraw> drawLights(const Scene& scene, const glm::vec3& origin, uint32_t count, Rays rays,
                                  uint32_t sampler) {
    LightHarness harness(scene, kernels::lights_sample, {{gpu::kConstantSampler, sampler}});
    gpu::LightHarnessParams params{};
    params.origin = glm::vec4(origin, 0.0f);
    params.normal = glm::vec4(glm::vec3(kReceiverNormal), 0.0f);
    params.count = count;
    params.triangleCount = rays == Rays::Cast ? harness.triangles() : 0;
    const auto records = harness.run(params, 5, 3 * size_t(count));
    std::vector<LightDraw> samples;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec4 r0 = toFloats(records[3 * i]), r1 = toFloats(records[3 * i + 1]);
        const glm::vec4 r2 = toFloats(records[3 * i + 2]);
        samples.push_back({Vec3(r0), r0.w, glm::vec3(r1), r1.w, r2.x, r2.y, records[3 * i + 2].z,
                           records[3 * i + 2].w != 0});
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
    for (const PunctualLight& p : scene.lights) {
        if (p.kind == PunctualLight::Kind::Directional) continue;
        const Vec3 at(p.position);
        TreeLight light{{at, at, at}, reference::luminance(Vec3(p.intensity)), false};
        light.cone = EmissionCone{Vec3(p.direction), reference::kPi}; // to all sides
        if (p.kind == PunctualLight::Kind::Spot) {
            light.cone->spread = p.innerAngle;
            light.cone->reach = double(p.outerAngle) - double(p.innerAngle);
        }
        lights.push_back(light);
    }
    return buildLightTree(lights);
}

namespace {

struct Choice {
    uint32_t light;
    double chance; // with which it was chosen, 0 = none
    double found;  // that a ray which meets it finds
};

std::vector<Choice> chooseLights(const Scene& scene, const glm::vec3& point, uint32_t count,
                                 uint32_t sampler) {
    LightHarness harness(scene, kernels::lights_choose, {{gpu::kConstantSampler, sampler}});
    gpu::LightHarnessParams params{};
    params.origin = glm::vec4(point, 0.0f);
    params.normal = glm::vec4(glm::vec3(kReceiverNormal), 0.0f);
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

ChoiceAgreement compareChoices(const Scene& scene, const glm::vec3& point, uint32_t samples,
                               uint32_t sampler) {
    const std::vector<double> chances = lightChances(treeOf(scene), {Vec3(point), kReceiverNormal});
    const size_t none = chances.size(); // the way down met no light
    std::vector<double> counts(none + 1), expected(none + 1);
    ChoiceAgreement result;
    for (const Choice& c : chooseLights(scene, point, samples, sampler)) {
        counts[c.chance > 0.0 ? c.light : none] += 1.0;
        if (c.chance == 0.0) continue;
        const double exact = chances[c.light];
        result.worst = std::max(result.worst, std::abs(c.chance - exact) / (exact + 1e-4));
        result.worstFound = std::max(result.worstFound, std::abs(c.found / c.chance - 1.0));
    }
    for (size_t i = 0; i < none; ++i) expected[i] = samples * chances[i];
    expected[none] = samples * std::max(1.0 - std::accumulate(chances.begin(), chances.end(), 0.0), 0.0);
    lumpRare(counts, expected);
    result.bins = counts.size();
    result.pValue = reference::chiSquareTest(counts, expected).pValue;
    for (size_t i = 0; i < counts.size(); i += 2) expected[i] *= 1.05;
    result.plantedPValue = reference::chiSquareTest(counts, expected).pValue;
    return result;
}

} // namespace irradia::test
