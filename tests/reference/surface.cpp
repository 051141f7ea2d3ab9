#include "tests/reference/surface.h"
#include "tests/reference/texture.h"

namespace irradia::reference {

namespace {

constexpr double kMinViewCosine = 0.01;

// Vertex attributes at barycentric coordinates (1 - u - v, u, v).
struct Interpolated {
    Vec3 normal;
    glm::dvec4 tangent;
    Vec2 uv[2];
};

Interpolated interpolate(const Scene& scene, const Triangle& triangle, double u, double v) {
    const Vertex& a = scene.vertices[triangle.vertex.x];
    const Vertex& b = scene.vertices[triangle.vertex.y];
    const Vertex& c = scene.vertices[triangle.vertex.z];
    const auto blend = [&](const auto& x, const auto& y, const auto& z) {
        return (1.0 - u - v) * x + u * y + v * z;
    };
    return {blend(Vec3(a.normal), Vec3(b.normal), Vec3(c.normal)),
            blend(glm::dvec4(a.tangent), glm::dvec4(b.tangent), glm::dvec4(c.tangent)),
            {blend(Vec2(a.uv[0]), Vec2(b.uv[0]), Vec2(c.uv[0])),
             blend(Vec2(a.uv[1]), Vec2(b.uv[1]), Vec2(c.uv[1]))}};
}

glm::dvec4 lookUp(const Scene& scene, const TextureRef& texture, const Interpolated& at, Encoding encoding) {
    return sampleTexture(scene, texture, at.uv[texture.uvSet], encoding);
}

BsdfParameters bsdfParameters(const Scene& scene, const Material& m, const Interpolated& at) {
    const glm::dvec4 metallicRoughness = lookUp(scene, m.metallicRoughnessTexture, at, Encoding::Linear);
    const double ratio = (static_cast<double>(m.ior) - 1.0) / (static_cast<double>(m.ior) + 1.0);
    const Vec3 specularColor =
        Vec3(m.specularColor) * Vec3(lookUp(scene, m.specularColorTexture, at, Encoding::Srgb));
    BsdfParameters p;
    p.baseColor = Vec3(m.baseColor) * Vec3(lookUp(scene, m.baseColorTexture, at, Encoding::Srgb));
    p.roughness = static_cast<double>(m.roughness) * metallicRoughness.y;
    p.metallic = static_cast<double>(m.metallic) * metallicRoughness.z;
    p.f0 = glm::min(ratio * ratio * specularColor, Vec3(1.0));
    p.specular = static_cast<double>(m.specular) * lookUp(scene, m.specularTexture, at, Encoding::Linear).w;
    return p;
}

// Unit normal of the front side: the vertices' one, turned by the normal map where there is one and a
// tangent.
Vec3 shadingNormal(const Scene& scene, const Material& m, const Interpolated& at,
                   const Vec3& geometricNormal) {
    if (glm::length(at.normal) < 1e-12) return geometricNormal;
    const Vec3 n = glm::normalize(at.normal);
    const Vec3 along = Vec3(at.tangent) - glm::dot(Vec3(at.tangent), n) * n;
    if (m.normalTexture.image < 0 || glm::length(along) < 1e-12) return n;
    const Vec3 tangent = glm::normalize(along);
    const Vec3 bitangent = at.tangent.w * glm::cross(n, tangent);
    const Vec3 t = 2.0 * Vec3(lookUp(scene, m.normalTexture, at, Encoding::Linear)) - 1.0;
    const double scale = m.normalScale;
    return glm::normalize(scale * t.x * tangent + scale * t.y * bitangent + t.z * n);
}

} // namespace

Vec3 SurfacePoint::scattered(const Vec3& direction) const {
    if (glm::dot(geometricNormal, direction) <= 0.0) return Vec3(0.0);
    const Vec3 l = shading.toLocal(direction);
    return bsdf.evaluate(view, l) * std::fmax(l.z, 0.0);
}

double SurfacePoint::pdf(const Vec3& direction) const {
    return bsdf.pdf(view, shading.toLocal(direction));
}

std::vector<TriangleShape> triangleShapes(const Scene& scene) {
    std::vector<TriangleShape> shapes;
    for (const Triangle& t : scene.triangles) {
        const Vec3 p0 = scene.vertices[t.vertex.x].position;
        shapes.push_back({p0, Vec3(scene.vertices[t.vertex.y].position) - p0,
                          Vec3(scene.vertices[t.vertex.z].position) - p0});
    }
    return shapes;
}

SurfacePoint surfaceAt(const Scene& scene, const TriangleShape& shape, const Ray& ray, const Hit& hit) {
    const Triangle& triangle = scene.triangles[hit.triangle];
    const Material& material = scene.materials[triangle.material];
    const Interpolated at = interpolate(scene, triangle, hit.u, hit.v);
    const Vec3 toViewer = -ray.direction;

    Vec3 geometric = glm::normalize(glm::cross(shape.e1, shape.e2));
    Vec3 normal = shadingNormal(scene, material, at, geometric);
    if (glm::dot(geometric, toViewer) <= 0.0) geometric = -geometric, normal = -normal;
    const double cosine = glm::dot(normal, toViewer);
    if (cosine < kMinViewCosine) normal = glm::normalize(normal + (kMinViewCosine - cosine) * toViewer);

    const Frame frame(normal);
    const double extent = maxComponent(glm::abs(shape.p0) + glm::abs(shape.e1) + glm::abs(shape.e2));
    return {shape.p0 + hit.u * shape.e1 + hit.v * shape.e2,
            geometric,
            0x1p-44 * extent, // 512 roundings: slivers err more than others
            frame,
            frame.toLocal(toViewer),
            Bsdf(bsdfParameters(scene, material, at))};
}

Vec3 emittedRadiance(const Scene& scene, uint32_t triangle, const Vec2& uv, bool front) {
    const Material& material = scene.materials[scene.triangles[triangle].material];
    if (!front && !material.doubleSided) return Vec3(0.0);
    if (material.emissiveTexture.image < 0 || material.emission == glm::vec3(0.0f))
        return Vec3(material.emission);
    const Interpolated at = interpolate(scene, scene.triangles[triangle], uv.x, uv.y);
    return Vec3(material.emission) * Vec3(lookUp(scene, material.emissiveTexture, at, Encoding::Srgb));
}

} // namespace irradia::reference
