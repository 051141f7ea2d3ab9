// Light samples and choices of lights as the shaders draw them, and the hierarchy that they descend.
#pragma once

#include "engine/scene/lights/light_tree.h"
#include "tests/reference/math.h"
#include "tests/support/light_harness.h"

namespace irradia::test {

// With Sobol' points one number makes a chain of choices, with random ones each has its own.
inline constexpr uint32_t kSamplers[] = {gpu::kSamplerRandom, gpu::kSamplerSobol};
inline constexpr double kConeRounding =
    0.01; // of octahedral axes, some 1e-4: it shows where a cone just ends
extern const reference::Vec3 kReceiverNormal; // of all that follows

struct LightDraw {
    reference::Vec3 direction;
    float tMax;
    glm::vec3 radiance;
    double pdf;
    double hitPdf; // that a ray in the direction finds
    double hitDistance;
    uint32_t hitPrimitive;
    bool isPunctual;

    bool isFarAway() const { return tMax == 1e30f; }
    bool isEnvironment() const { return isFarAway() && !isPunctual; }
};

enum class Rays { Cast, None };

std::vector<LightDraw> drawLights(const Scene& scene, const glm::vec3& origin, uint32_t count, Rays rays,
                                  uint32_t sampler = gpu::kSamplerRandom);

// The hierarchy of a scene all of whose triangles emit; its points and spots come after them.
LightTree treeOf(const Scene& scene);

// Choices among a scene's local lights by their hierarchy at a point, beside those that its twin expects.
struct ChoiceAgreement {
    double worst = 0.0;      // relative error of the chances with which they were chosen
    double worstFound = 0.0; // of those that a ray which meets the light finds
    size_t bins = 0;
    double pValue = 0.0, plantedPValue = 0.0; // of the counts; against every second chance 5 % off
};
ChoiceAgreement compareChoices(const Scene& scene, const glm::vec3& point, uint32_t samples,
                               uint32_t sampler);

} // namespace irradia::test
