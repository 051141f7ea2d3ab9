#include "tests/reference/surface.h"
#include "tests/reference/material_point.h"
#include "tests/reference/passing.h"

namespace irradia::reference {

namespace {

constexpr double kMinViewCosine = 0.01;

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

// Indices whose ratio is nearer to 1 are taken as this much apart: there the refracted lobe becomes a point,
// which a density cannot state.
constexpr double kLeastStep = 1e-4;

double indexRatio(const Scene& scene, const MediaBySide& media, bool front) {
    const double eta = indexOf(scene, media.there.top) / indexOf(scene, media.here.top);
    if (std::abs(eta - 1.0) >= kLeastStep) return eta;
    return front ? 1.0 + kLeastStep : 1.0 / (1.0 + kLeastStep); // in and out again is 1
}

std::optional<Glass> glassAt(const Scene& scene, const Material& m, const Interpolated& at,
                             BsdfParameters surface, const MediaBySide& media, bool front) {
    if (m.transmission == 0.0f) return std::nullopt;
    GlassParameters glass;
    glass.transmission = transmissionAt(scene, m, at);
    if (isSolid(m)) {
        glass.kind = GlassParameters::Kind::Solid;
        glass.eta = indexRatio(scene, media, front);
        surface.f0 = f0Between(surface.f0, m.ior, glass.eta);
    } else {
        using Kind = GlassParameters::Kind;
        glass.kind = isClearSheet(m) ? Kind::ClearSheet : Kind::RoughSheet;
    }
    return Glass(surface, glass);
}

} // namespace

bool SurfacePoint::isValid(const Vec3& direction) const {
    return glm::dot(geometricNormal, direction) * glm::dot(shading.normal, direction) > 0.0;
}

Vec3 SurfacePoint::scattered(const Vec3& direction) const {
    if (!isValid(direction)) return Vec3(0.0);
    const Vec3 l = shading.toLocal(direction);
    return etendue(direction) * std::abs(l.z) * (glass ? glass->evaluate(view, l) : bsdf.evaluate(view, l));
}

Vec3 SurfacePoint::scatteredPunctual(const Vec3& direction) const {
    if (alpha() > kMinAlpha) return scattered(direction);
    if (!isValid(direction)) return Vec3(0.0);
    const Vec3 l = shading.toLocal(direction);
    return std::abs(l.z) *
           (glass ? glass->evaluate(view, l, GlassLobes::Lambert) : bsdf.evaluate(view, l, Lobes::Diffuse));
}

double SurfacePoint::pdf(const Vec3& direction) const {
    const Vec3 l = shading.toLocal(direction);
    return glass ? glass->pdf(view, l) : bsdf.pdf(view, l);
}

BsdfSample SurfacePoint::sample(double uLobe, const Vec2& u) const {
    BsdfSample sample = glass ? glass->sample(view, uLobe, u) : bsdf.sample(view, uLobe, u);
    if (glass) sample.weight *= glass->etendue(sample.direction);
    sample.direction = shading.toWorld(sample.direction);
    return sample;
}

double SurfacePoint::etendue(const Vec3& direction) const {
    return glass ? glass->etendue(shading.toLocal(direction)) : 1.0;
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

SurfacePoint surfaceAt(const Scene& scene, const TriangleShape& shape, const Ray& ray, const Hit& hit,
                       const Media& media) {
    const Triangle& triangle = scene.triangles[hit.triangle];
    const Material& material = scene.materials[triangle.material];
    const Interpolated at = interpolate(scene, triangle, {hit.u, hit.v});
    const Vec3 toViewer = -ray.direction;

    Vec3 geometric = glm::normalize(glm::cross(shape.e1, shape.e2));
    Vec3 normal = shadingNormal(scene, material, at, geometric);
    if (glm::dot(geometric, toViewer) <= 0.0) geometric = -geometric, normal = -normal;
    const double cosine = glm::dot(normal, toViewer);
    if (cosine < kMinViewCosine) normal = glm::normalize(normal + (kMinViewCosine - cosine) * toViewer);

    const Frame frame(normal);
    const double extent = maxComponent(glm::abs(shape.p0) + glm::abs(shape.e1) + glm::abs(shape.e2));
    const bool front = isFront(shape, ray);
    const MediaBySide sides = mediaAt(scene, triangle.material, front, media);
    const BsdfParameters parameters = bsdfParameters(scene, material, at);
    return {shape.p0 + hit.u * shape.e1 + hit.v * shape.e2,
            geometric,
            0x1p-44 * extent, // 512 roundings: slivers err more than others
            frame,
            frame.toLocal(toViewer),
            Bsdf(parameters),
            glassAt(scene, material, at, parameters, sides, front),
            sides};
}

bool isFront(const TriangleShape& shape, const Ray& ray) {
    return glm::dot(glm::cross(shape.e1, shape.e2), ray.direction) < 0.0;
}

Vec3 emittedRadiance(const Scene& scene, uint32_t triangle, const Vec2& uv, bool front) {
    const Material& material = scene.materials[scene.triangles[triangle].material];
    if (!front && !material.doubleSided) return Vec3(0.0);
    if (material.emission == glm::vec3(0.0f)) return Vec3(0.0);
    const Interpolated at = interpolate(scene, scene.triangles[triangle], uv);
    return coverageAt(scene, material, at) * emissionAt(scene, material, at);
}

} // namespace irradia::reference
