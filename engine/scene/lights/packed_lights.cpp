#include "engine/scene/lights/packed_lights.h"

#include "engine/scene/lights/alias_table.h"
#include "engine/scene/lights/environment_reduction.h"
#include "engine/scene/lights/light_tree.h"
#include "engine/scene/lights/punctual_lights.h"
#include "engine/scene/texture_packing.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace irradia {

namespace {

double luminance(const glm::dvec3& c) {
    return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
}

glm::dvec3 meanColor(const TextureImage& image) {
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < image.rgba.size(); i += 4)
        sum += glm::dvec3(srgbToLinear(image.rgba[i]), srgbToLinear(image.rgba[i + 1]),
                          srgbToLinear(image.rgba[i + 2]));
    return sum / std::max(1.0, double(image.rgba.size() / 4));
}

glm::dvec3 texel(const Environment& e, int x, int y) {
    const int wrapped = (x % e.width + e.width) % e.width;
    const int clamped = std::clamp(y, 0, e.height - 1);
    return e.texels[size_t(clamped) * size_t(e.width) + size_t(wrapped)];
}

// Integral over a texel of the bilinear interpolation, in units of the texel: weights 1/8, 6/8, 1/8 along
// each axis.
double meanLuminance(const Environment& e, int x, int y) {
    constexpr double kWeight[3] = {0.125, 0.75, 0.125};
    double sum = 0.0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            sum += kWeight[dx + 1] * kWeight[dy + 1] * luminance(texel(e, x + dx, y + dy));
    return sum;
}

// Local lights, and what each record names: a primitive, or a punctual light.
struct LocalLights {
    std::vector<TreeLight> lights;
    std::vector<uint32_t> names;
};

void packAliasTable(const LocalLights& local, std::vector<glm::uvec4>& out) {
    std::vector<double> powers;
    for (const TreeLight& light : local.lights) powers.push_back(light.power);
    const std::vector<AliasEntry> table = buildAliasTable(powers);
    for (size_t i = 0; i < table.size(); ++i)
        out.emplace_back(std::bit_cast<uint32_t>(table[i].keep), table[i].alias, local.names[i],
                         std::bit_cast<uint32_t>(static_cast<float>(table[i].mass)));
}

// Where there are points or spots, spread and reach share their bits.
uint32_t packCone(const EmissionCone& cone, bool hasReach) {
    if (!hasReach) return std::bit_cast<uint32_t>(static_cast<float>(std::cos(cone.spread)));
    const auto code = [](double angle) { return uint32_t(std::ceil(65535.0 * std::sin(0.5 * angle))); };
    return code(cone.spread) | code(cone.reach) << 16;
}

// Bounds are a little wider than the tree's, by what rounding them takes.
void packTree(const LocalLights& local, bool hasReach, std::vector<glm::uvec4>& out) {
    const LightTree tree = buildLightTree(local.lights);
    for (size_t i = 0; i < tree.trails.size(); ++i) out.emplace_back(tree.trails[i], 0u, local.names[i], 0u);
    const double total = tree.nodes[0].power;
    for (const LightTreeNode& node : tree.nodes) {
        const glm::vec3 center(node.center);
        const double reach =
            std::max({std::abs(node.center.x), std::abs(node.center.y), std::abs(node.center.z)});
        const auto radius = static_cast<float>(1.000001 * node.radius + 2e-7 * reach);
        const auto share = static_cast<float>(total > 0.0 ? node.power / total : 0.0);
        out.push_back(std::bit_cast<glm::uvec4>(glm::vec4(center, radius)));
        out.emplace_back(packOctahedral(glm::vec3(node.cone.axis)), packCone(node.cone, hasReach),
                         std::bit_cast<uint32_t>(share),
                         node.isLeaf ? gpu::kLightLeaf | node.child : node.child);
    }
}

} // namespace

std::vector<double> emissiveLuminances(const Scene& scene) {
    std::vector<double> result;
    for (const Material& m : scene.materials) {
        glm::dvec3 emission(m.emission);
        if (emission != glm::dvec3(0.0) && m.emissiveTexture.image >= 0)
            emission *= meanColor(scene.images[m.emissiveTexture.image]);
        result.push_back(luminance(emission) * (m.doubleSided ? 2.0 : 1.0));
    }
    return result;
}

LightShares lightShares(const Scene& scene, const SceneNeeds& needs) {
    const std::vector<double> luminances = emissiveLuminances(scene);
    const bool environment = !scene.environment.isBlack();
    const bool directional = (needs.punctual & gpu::kPunctualDirectional) != 0;
    const bool local =
        (needs.punctual & gpu::kPunctualLocal) != 0 ||
        std::ranges::any_of(scene.triangles, [&](const Triangle& t) { return luminances[t.material] > 0.0; });
    const int groups = int(environment) + int(directional) + int(local);
    if (groups == 0) return {needs.environment ? 1.0f : 0.0f, 0.0f, needs.environment ? 0.0f : 1.0f};
    const float share = 1.0f / static_cast<float>(groups);
    return {environment ? share : 0.0f, directional ? share : 0.0f, local ? share : 0.0f};
}

PackedLights packLights(const Scene& scene, const std::vector<bool>& emitters) {
    const std::vector<double> luminances = emissiveLuminances(scene);
    PackedLights out;
    out.lightOf.resize(scene.triangles.size(), gpu::kNoLight);
    LocalLights local;
    for (size_t i = 0; i < scene.triangles.size(); ++i) {
        const Triangle& t = scene.triangles[i];
        if (!emitters[t.material]) continue;
        TreeLight light;
        for (int k = 0; k < 3; ++k) light.corners[k] = scene.vertices[t.vertex[k]].position;
        const auto& [a, b, c] = light.corners;
        light.power = 0.5 * glm::length(glm::cross(b - a, c - a)) * luminances[t.material];
        light.isTwoSided = scene.materials[t.material].doubleSided;
        out.lightOf[i] = out.emitters++;
        local.lights.push_back(light);
        local.names.push_back(static_cast<uint32_t>(i));
    }
    const PackedPunctualLights punctual = packPunctualLights(scene);
    for (const PunctualLight* light : localPunctualLights(scene)) {
        const auto index = static_cast<uint32_t>(local.lights.size()) - out.emitters;
        local.lights.push_back(treeLight(*light));
        local.names.push_back(gpu::kPunctual | (punctual.directional + index));
    }
    out.count = static_cast<uint32_t>(local.lights.size());
    if (out.count >= kLightTreeFrom)
        packTree(local, out.count > out.emitters, out.quads);
    else
        packAliasTable(local, out.quads);
    out.directional = punctual.directional;
    out.firstPunctual = static_cast<uint32_t>(out.quads.size());
    out.quads.insert(out.quads.end(), punctual.quads.begin(), punctual.quads.end());
    return out;
}

void packEnvironment(const Environment& environment, PackedScene& out, uint64_t maxTexels) {
    Environment picture = environment;
    if (picture.texels.empty()) {
        picture.width = 64;
        picture.height = 32;
        picture.texels.assign(64 * 32, environment.constant);
    }
    reduceToFit(picture, maxTexels);
    if (!environment.texels.empty() && picture.width != environment.width)
        out.warnings.push_back(fmt::format("the environment of {}x{} was reduced to {}x{} to fit",
                                           environment.width, environment.height, picture.width,
                                           picture.height));
    const size_t count = picture.texels.size();
    std::vector<double> weights(count);
    for (int y = 0; y < picture.height; ++y) {
        // Mean of sin(theta) over the row.
        const double top = std::cos(std::numbers::pi * y / picture.height);
        const double bottom = std::cos(std::numbers::pi * (y + 1) / picture.height);
        for (int x = 0; x < picture.width; ++x)
            weights[size_t(y) * size_t(picture.width) + size_t(x)] =
                meanLuminance(picture, x, y) * (top - bottom);
    }
    const std::vector<AliasEntry> table = buildAliasTable(weights);
    for (size_t i = 0; i < count; ++i) {
        const float density = static_cast<float>(table[i].mass * double(count));
        out.environment.push_back(std::bit_cast<glm::uvec4>(glm::vec4(picture.texels[i], density)));
        out.environmentAlias.emplace_back(std::bit_cast<uint32_t>(table[i].keep), table[i].alias, 0u, 0u);
    }
    out.environmentWidth = static_cast<uint32_t>(picture.width);
    out.environmentHeight = static_cast<uint32_t>(picture.height);
}

} // namespace irradia
