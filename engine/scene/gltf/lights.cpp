#include "engine/scene/gltf/lights.h"

#include "engine/scene/gltf/values.h"
#include <algorithm>

namespace irradia::gltf {
namespace {

constexpr double kMaxRange = 1e18; // its fourth power still fits a float's range of ratios

PunctualLight::Kind kindOf(const tinygltf::Light& light) {
    if (light.type == "spot") return PunctualLight::Kind::Spot;
    return light.type == "directional" ? PunctualLight::Kind::Directional : PunctualLight::Kind::Point;
}

PunctualLight readLight(const SourceFile& source, const tinygltf::Model& model, size_t index) {
    const tinygltf::Light& from = model.lights[index];
    const Thing owner{thing("light", "lights", index, from.name).name,
                      fmt::format("/extensions/KHR_lights_punctual/lights/{}", index)};
    const Values values(source, owner);
    PunctualLight light;
    light.name = from.name;
    light.kind = kindOf(from);
    std::vector<double> intensity = from.color.empty() ? std::vector<double>(3, 1.0) : from.color;
    for (double& channel : intensity) channel *= from.intensity;
    light.intensity = values.colour("color x intensity", intensity, kMaxRadiance);
    if (light.kind != PunctualLight::Kind::Directional && from.range < kMaxRange)
        light.range = static_cast<float>(from.range);
    light.innerAngle = static_cast<float>(from.spot.innerConeAngle);
    light.outerAngle = static_cast<float>(from.spot.outerConeAngle);
    return light;
}

std::vector<Placement> lightNodes(const tinygltf::Model& model, const std::vector<Placement>& nodes) {
    std::vector<Placement> ordered;
    std::ranges::copy_if(nodes, std::back_inserter(ordered), [&](const Placement& placement) {
        return lightOf(model.nodes[placement.node]) >= 0;
    });
    std::ranges::sort(ordered, {}, &Placement::node);
    return ordered;
}

// Shines along the node's -Z, as its matrix has it: mirrors turn it too.
bool place(PunctualLight& light, const glm::dmat4& toWorld) {
    const glm::dvec3 position(toWorld[3]), direction(-toWorld[2]);
    const double length = glm::length(direction);
    if (light.kind != PunctualLight::Kind::Directional) {
        if (!isFinite(glm::vec3(position))) return false;
        light.position = position;
    }
    if (light.kind != PunctualLight::Kind::Point) {
        if (!(length > 0 && std::isfinite(length))) return false;
        light.direction = direction / length;
    }
    return true;
}

} // namespace

int lightOf(const tinygltf::Node& node) {
    const Extension extension = findExtension(node.extensions, "KHR_lights_punctual");
    return extension && extension->Has("light") ? extension->Get("light").GetNumberAsInt() : -1;
}

std::vector<PunctualLight> placeLights(const SourceFile& source, const tinygltf::Model& model,
                                       const std::vector<Placement>& nodes) {
    std::vector<PunctualLight> lights;
    for (const Placement& placement : lightNodes(model, nodes)) {
        const tinygltf::Node& node = model.nodes[placement.node];
        PunctualLight light = readLight(source, model, static_cast<size_t>(lightOf(node)));
        if (light.name.empty()) light.name = node.name;
        if (!place(light, placement.toWorld))
            source.note(Severity::Warning,
                        thing("node", "nodes", static_cast<size_t>(placement.node)).pointer, {},
                        label("light", static_cast<size_t>(lightOf(node)), light.name) +
                            " is left out: its node has no orientation");
        else if (light.intensity != glm::vec3(0.0f))
            lights.push_back(std::move(light));
    }
    return lights;
}

std::vector<glm::dvec3> lightPositions(const tinygltf::Model& model, const std::vector<Placement>& nodes) {
    std::vector<glm::dvec3> positions;
    for (const Placement& placement : lightNodes(model, nodes)) {
        const glm::dvec3 position(placement.toWorld[3]);
        const size_t light = static_cast<size_t>(lightOf(model.nodes[placement.node]));
        if (kindOf(model.lights[light]) != PunctualLight::Kind::Directional && isFinite(glm::vec3(position)))
            positions.push_back(position);
    }
    return positions;
}

} // namespace irradia::gltf
