#include "tests/reference/material_point.h"
#include "tests/reference/fresnel.h"
#include <algorithm>

namespace irradia::reference {

Interpolated interpolate(const Scene& scene, const Triangle& triangle, const Vec2& uv) {
    const Vertex& a = scene.vertices[triangle.vertex.x];
    const Vertex& b = scene.vertices[triangle.vertex.y];
    const Vertex& c = scene.vertices[triangle.vertex.z];
    const auto blend = [&](const auto& x, const auto& y, const auto& z) {
        return (1.0 - uv.x - uv.y) * x + uv.x * y + uv.y * z;
    };
    // Exact where all corners agree: a cutoff at 1 may stand beside an alpha of 1.
    const glm::dvec4 first(a.color);
    const glm::dvec4 color =
        first + uv.x * (glm::dvec4(b.color) - first) + uv.y * (glm::dvec4(c.color) - first);
    return {blend(Vec3(a.normal), Vec3(b.normal), Vec3(c.normal)),
            blend(glm::dvec4(a.tangent), glm::dvec4(b.tangent), glm::dvec4(c.tangent)),
            {blend(Vec2(a.uv[0]), Vec2(b.uv[0]), Vec2(c.uv[0])),
             blend(Vec2(a.uv[1]), Vec2(b.uv[1]), Vec2(c.uv[1]))},
            color};
}

glm::dvec4 lookUp(const Scene& scene, const TextureRef& texture, const Interpolated& at, Encoding encoding) {
    return sampleTexture(scene, texture, at.uv[texture.uvSet], encoding);
}

BsdfParameters bsdfParameters(const Scene& scene, const Material& m, const Interpolated& at) {
    const glm::dvec4 metallicRoughness = lookUp(scene, m.metallicRoughnessTexture, at, Encoding::Linear);
    const Vec3 specularColor =
        Vec3(m.specularColor) * Vec3(lookUp(scene, m.specularColorTexture, at, Encoding::Srgb));
    BsdfParameters p;
    p.baseColor = glm::min(Vec3(m.baseColor) * Vec3(lookUp(scene, m.baseColorTexture, at, Encoding::Srgb)) *
                               Vec3(at.color),
                           Vec3(1.0));
    p.roughness = static_cast<double>(m.roughness) * metallicRoughness.y;
    p.metallic = static_cast<double>(m.metallic) * metallicRoughness.z;
    p.f0 = glm::min(normalReflectance(m.ior) * specularColor, Vec3(1.0));
    p.specular = static_cast<double>(m.specular) * lookUp(scene, m.specularTexture, at, Encoding::Linear).w;
    return p;
}

double transmissionAt(const Scene& scene, const Material& m, const Interpolated& at) {
    if (m.transmission == 0.0f) return 0.0;
    return static_cast<double>(m.transmission) * lookUp(scene, m.transmissionTexture, at, Encoding::Linear).x;
}

double coverageAt(const Scene& scene, const Material& m, const Interpolated& at) {
    if (m.alphaMode == AlphaMode::Opaque) return 1.0;
    const double texture = lookUp(scene, m.baseColorTexture, at, Encoding::Srgb).w;
    const double alpha = std::clamp(static_cast<double>(m.alpha) * texture * at.color.w, 0.0, 1.0);
    if (m.alphaMode == AlphaMode::Blend) return alpha;
    return alpha >= static_cast<double>(m.alphaCutoff) ? 1.0 : 0.0;
}

Vec3 emissionAt(const Scene& scene, const Material& m, const Interpolated& at) {
    if (m.emission == glm::vec3(0.0f)) return Vec3(0.0);
    const Vec3 emission = Vec3(m.emission) * Vec3(lookUp(scene, m.emissiveTexture, at, Encoding::Srgb));
    return m.isUnlit ? emission * Vec3(at.color) : emission;
}

} // namespace irradia::reference
