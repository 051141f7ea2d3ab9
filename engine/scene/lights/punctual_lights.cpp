#include "engine/scene/lights/punctual_lights.h"

#include "engine/scene/lights/alias_table.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace irradia {

namespace {

using Kind = PunctualLight::Kind;

double powerOf(const PunctualLight& light) {
    return glm::dot(glm::dvec3(light.intensity), glm::dvec3(0.2126, 0.7152, 0.0722));
}

std::vector<const PunctualLight*> shining(const Scene& scene, bool directional) {
    std::vector<const PunctualLight*> lights;
    for (const PunctualLight& light : scene.lights)
        if ((light.kind == Kind::Directional) == directional && powerOf(light) > 0.0)
            lights.push_back(&light);
    return lights;
}

void append(std::vector<glm::uvec4>& quads, const glm::vec3& xyz, float w) {
    quads.push_back(std::bit_cast<glm::uvec4>(glm::vec4(xyz, w)));
}

void packDirectional(const std::vector<const PunctualLight*>& lights, std::vector<glm::uvec4>& quads) {
    std::vector<double> powers;
    for (const PunctualLight* light : lights) powers.push_back(powerOf(*light));
    const std::vector<AliasEntry> table = buildAliasTable(powers);
    for (size_t i = 0; i < lights.size(); ++i) {
        append(quads, -lights[i]->direction, table[i].keep);
        append(quads, lights[i]->intensity, static_cast<float>(table[i].mass));
        quads.emplace_back(table[i].alias, 0u, 0u, 0u);
    }
}

void packLocal(const PunctualLight& light, std::vector<glm::uvec4>& quads) {
    constexpr float kNoEdge = -2.0f; // every cosine is more than 1 above it
    const bool isSpot = light.kind == Kind::Spot;
    const double inner = std::cos(double(light.innerAngle)), outer = std::cos(double(light.outerAngle));
    append(quads, light.position, light.range > 0.0f ? 1.0f / light.range : 0.0f);
    append(quads, light.intensity, isSpot ? static_cast<float>(1.0 / std::max(inner - outer, 0.001)) : 1.0f);
    append(quads, light.direction, isSpot ? static_cast<float>(outer) : kNoEdge);
}

} // namespace

uint32_t punctualKinds(const Scene& scene) {
    return (shining(scene, false).empty() ? 0u : gpu::kPunctualLocal) |
           (shining(scene, true).empty() ? 0u : gpu::kPunctualDirectional);
}

std::vector<const PunctualLight*> localPunctualLights(const Scene& scene) {
    return shining(scene, false);
}

// A spot shines along its axis and all that lies within its inner angle, and from there as far as to its
// outer one.
TreeLight treeLight(const PunctualLight& light) {
    TreeLight result;
    for (glm::dvec3& corner : result.corners) corner = light.position;
    result.power = powerOf(light);
    if (light.kind == Kind::Spot) {
        const double outer = light.outerAngle, inner = std::min(double(light.innerAngle), outer);
        result.cone = EmissionCone{glm::normalize(glm::dvec3(light.direction)), inner, outer - inner};
    } else
        result.cone = EmissionCone{{0, 0, 1}, std::numbers::pi, 0.5 * std::numbers::pi};
    return result;
}

PackedPunctualLights packPunctualLights(const Scene& scene) {
    PackedPunctualLights out;
    const std::vector<const PunctualLight*> directional = shining(scene, true);
    out.directional = static_cast<uint32_t>(directional.size());
    packDirectional(directional, out.quads);
    for (const PunctualLight* light : localPunctualLights(scene)) packLocal(*light, out.quads);
    return out;
}

} // namespace irradia
