#include "tests/reference/punctual_lights.h"
#include "tests/reference/discrete_distribution.h"

namespace irradia::reference {

namespace {

// The light's end at its range: max(1 - (d / range)^4, 0).
double window(const PunctualLight& light, double distance) {
    if (light.range <= 0.0f) return 1.0;
    const double ratio = distance / static_cast<double>(light.range);
    return std::max(1.0 - ratio * ratio * ratio * ratio, 0.0);
}

// Share of a spot's light in a direction from it.
double cone(const PunctualLight& light, const Vec3& fromLight) {
    if (light.kind != PunctualLight::Kind::Spot) return 1.0;
    const double inner = std::cos(static_cast<double>(light.innerAngle));
    const double outer = std::cos(static_cast<double>(light.outerAngle));
    const double cosine = glm::dot(Vec3(light.direction), fromLight);
    const double linear = std::clamp((cosine - outer) / std::max(inner - outer, 1e-3), 0.0, 1.0);
    return linear * linear;
}

} // namespace

PunctualSample illuminate(const PunctualLight& light, const Vec3& receiver) {
    if (light.kind == PunctualLight::Kind::Directional)
        return {-glm::normalize(Vec3(light.direction)), 1e300, Vec3(light.intensity), 1.0};
    const Vec3 toLight = Vec3(light.position) - receiver;
    const double distance = glm::length(toLight);
    if (distance == 0.0) return {};
    const Vec3 direction = toLight / distance;
    const double falloff = window(light, distance) * cone(light, -direction) / (distance * distance);
    return {direction, distance, falloff * Vec3(light.intensity), 1.0};
}

PunctualSample samplePunctual(const std::vector<PunctualLight>& lights, const Vec3& receiver, double u) {
    std::vector<PunctualSample> samples;
    std::vector<double> weights;
    for (const PunctualLight& light : lights) {
        samples.push_back(illuminate(light, receiver));
        weights.push_back(luminance(samples.back().irradiance));
    }
    const DiscreteDistribution distribution(weights);
    if (!(distribution.total() > 0.0)) return {};
    const size_t chosen = distribution.sample(u).first;
    PunctualSample sample = samples[chosen];
    sample.chance = distribution.probability(chosen);
    return sample;
}

} // namespace irradia::reference
