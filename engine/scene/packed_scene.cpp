#include "engine/scene/packed_scene.h"

#include "engine/error.h"
#include "engine/scene/lights/packed_lights.h"
#include "engine/scene/lights/punctual_lights.h"
#include "engine/scene/texture_packing.h"
#include "engine/scene/transparency.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace irradia {

namespace {

uint32_t bits(float value) {
    return std::bit_cast<uint32_t>(value);
}

glm::uvec4 quad(const glm::vec3& v, uint32_t w) {
    return glm::uvec4(bits(v.x), bits(v.y), bits(v.z), w);
}
glm::uvec4 quad(const glm::vec4& v) {
    return {bits(v.x), bits(v.y), bits(v.z), bits(v.w)};
}

void packGeometry(const Scene& scene, const std::vector<uint32_t>& lightOf, PackedScene& out) {
    out.geometry.reserve(scene.triangles.size() * gpu::kGeometryQuads);
    for (size_t i = 0; i < scene.triangles.size(); ++i) {
        const Triangle& t = scene.triangles[i];
        const Vertex& a = scene.vertices[t.vertex.x];
        const Vertex& b = scene.vertices[t.vertex.y];
        const Vertex& c = scene.vertices[t.vertex.z];
        const uint32_t handedness =
            (a.tangent.w < 0 ? 1u : 0u) | (b.tangent.w < 0 ? 2u : 0u) | (c.tangent.w < 0 ? 4u : 0u);
        out.geometry.push_back(quad(a.position, t.material));
        out.geometry.push_back(quad(b.position - a.position, lightOf[i]));
        out.geometry.push_back(quad(c.position - a.position, handedness));
        out.geometry.emplace_back(packOctahedral(a.normal), packOctahedral(b.normal),
                                  packOctahedral(c.normal), 0u);
    }
}

glm::uvec2 halves(const glm::vec4& v) {
    return {glm::packHalf2x16({v.x, v.y}), glm::packHalf2x16({v.z, v.w})};
}

void packAttributes(const Scene& scene, PackedScene& out) {
    const bool hasColors = (out.needs.textures & gpu::kVertexColors) != 0;
    out.attributes.reserve(scene.triangles.size() *
                           (hasColors ? gpu::kColouredAttributeQuads : gpu::kAttributeQuads));
    for (const Triangle& t : scene.triangles) {
        const Vertex& a = scene.vertices[t.vertex.x];
        const Vertex& b = scene.vertices[t.vertex.y];
        const Vertex& c = scene.vertices[t.vertex.z];
        out.attributes.push_back(quad(glm::vec4(a.uv[0], b.uv[0])));
        out.attributes.push_back(quad(glm::vec4(c.uv[0], a.uv[1])));
        out.attributes.push_back(quad(glm::vec4(b.uv[1], c.uv[1])));
        out.attributes.emplace_back(packOctahedral(glm::vec3(a.tangent)),
                                    packOctahedral(glm::vec3(b.tangent)),
                                    packOctahedral(glm::vec3(c.tangent)), 0u);
        if (!hasColors) continue;
        out.attributes.emplace_back(halves(a.color), halves(b.color));
        out.attributes.emplace_back(halves(c.color), glm::uvec2(0u));
    }
}

bool hasColors(const Scene& scene) {
    return std::ranges::any_of(scene.vertices, [](const Vertex& v) { return v.color != glm::vec4(1.0f); });
}

// Glass without a specular layer takes the layer's table too.
bool isSpecular(const Material& m) {
    return m.specular > 0.0f || m.metallic > 0.0f || m.transmission > 0.0f;
}

void packMaterials(const Scene& scene, PackedScene& out) {
    TexturePacker packer(scene);
    const auto use = [&](const TextureRef& ref, bool srgb, uint32_t bit) {
        if (ref.image >= 0) out.needs.textures |= bit;
        return packer.add(ref, srgb);
    };
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        const auto values = packMaterialValues(m);
        out.materials.insert(out.materials.end(), values.begin(), values.end());
        const uint32_t base = use(m.baseColorTexture, true, gpu::kBaseColorTexture);
        const uint32_t rough = use(m.metallicRoughnessTexture, false, gpu::kMetallicRoughnessTexture);
        const uint32_t normal = use(m.normalTexture, false, gpu::kNormalTexture);
        const bool emits = m.emission != glm::vec3(0.0f) || out.states.emitters[i];
        const uint32_t emissive =
            emits ? use(m.emissiveTexture, true, gpu::kEmissiveTexture) : gpu::kNoTexture;
        const uint32_t specular = use(m.specularTexture, false, gpu::kSpecularTexture);
        const uint32_t color = use(m.specularColorTexture, true, gpu::kSpecularColorTexture);
        const uint32_t transmission = use(m.transmissionTexture, false, gpu::kTransmissionTexture);
        out.materials.emplace_back(base, rough, normal, emissive);
        out.materials.emplace_back(specular, color, transmission, bits(m.ior));
        out.materials.push_back(quad(m.absorption, bits(m.transmission)));
    }
    if (hasColors(scene)) out.needs.textures |= gpu::kVertexColors;
    if (packer.hasTransforms()) out.needs.textures |= gpu::kTextureTransforms;
    out.needs.specular = out.states.specular;
    out.needs.glass = out.states.glass;
    packer.pack(kMaxBindingBytes / sizeof(glm::uvec2), out.textures, out.texels, out.warnings);
}

template <typename T>
void requireBinding(const std::vector<T>& part, const char* what) {
    const uint64_t bytes = part.size() * sizeof(T);
    if (bytes > kMaxBindingBytes)
        fail(ExitCode::OutOfMemory, "the scene's {} takes {} MiB, more than the {} MiB one binding may hold",
             what, bytes >> 20, kMaxBindingBytes >> 20);
}

} // namespace

uint32_t packOctahedral(const glm::vec3& n) {
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (!(sum > 0.0f)) return gpu::kNoTangent;
    glm::vec2 p(n.x / sum, n.y / sum);
    if (n.z < 0.0f)
        p = {(1.0f - std::abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f),
             (1.0f - std::abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f)};
    return glm::packSnorm2x16(p);
}

void PlannedStates::include(const Scene& state) {
    const std::vector<double> luminances = emissiveLuminances(state);
    emitters.resize(luminances.size(), false);
    for (size_t i = 0; i < luminances.size(); ++i) emitters[i] = emitters[i] || luminances[i] > 0.0;
    environment |= !state.environment.isBlack();
    for (const Material& material : state.materials) {
        specular |= isSpecular(material);
        glass |= scattersTransmitted(material);
    }
}

std::array<glm::uvec4, kMaterialValueQuads> packMaterialValues(const Material& m) {
    const float r = (m.ior - 1.0f) / (m.ior + 1.0f);
    const uint32_t flags = (m.doubleSided ? gpu::kMaterialDoubleSided : 0u) |
                           (m.alphaMode == AlphaMode::Mask ? gpu::kMaterialMask : 0u) |
                           (m.alphaMode == AlphaMode::Blend ? gpu::kMaterialBlend : 0u) |
                           (m.isUnlit ? gpu::kMaterialUnlit : 0u) | (isSheet(m) ? gpu::kMaterialSheet : 0u) |
                           (isSolid(m) ? gpu::kMaterialSolid : 0u);
    return {quad(glm::vec4(m.baseColor, m.metallic)), quad(glm::vec4(m.emission, m.roughness)),
            quad(glm::vec4(r * r * m.specularColor, m.specular)),
            glm::uvec4(bits(m.normalScale), flags, bits(m.alpha), bits(m.alphaCutoff))};
}

PackedScene packScene(const Scene& scene, const PlannedStates& states) {
    PackedScene out;
    out.origin = scene.origin;
    out.states = states;
    out.states.include(scene);
    PackedLights lights = packLights(scene, out.states.emitters);
    out.lights = std::move(lights.quads);
    out.lightCount = lights.count;
    out.directionalCount = lights.directional;
    out.firstPunctual = lights.firstPunctual;
    out.needs.emitters = lights.emitters > 0;
    out.needs.punctual = punctualKinds(scene);
    out.needs.lightTree = lights.count >= kLightTreeFrom;
    packMaterials(scene, out);
    packGeometry(scene, lights.lightOf, out);
    if (out.needs.textures != 0) packAttributes(scene, out);
    out.needs.transparency = letsLightThrough(scene);
    out.needs.environment = out.states.environment;
    if (out.needs.environment) packEnvironment(scene.environment, out);
    out.lightShares = lightShares(scene, out.needs);
    if (!out.needs.environment && !out.needs.emitters && out.needs.punctual == 0)
        out.warnings.push_back("the scene has no light: nothing in it emits, and no environment is given");
    requireBinding(out.geometry, "geometry");
    requireBinding(out.attributes, "texture coordinates");
    requireBinding(out.lights, "lights");
    requireBinding(out.environment, "environment");
    return out;
}

} // namespace irradia
