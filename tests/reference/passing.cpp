#include "tests/reference/passing.h"
#include "tests/reference/fresnel.h"
#include "tests/reference/material_point.h"

namespace irradia::reference {

namespace {

// T = (1 - m) tau base (1 - max Fd(V.N)), N without the normal map.
Vec3 throughClearSheet(const Scene& scene, const Material& material, const Interpolated& at,
                       const TriangleShape& shape, const Vec3& direction) {
    const bool hasNormal = glm::length(at.normal) >= 1e-12;
    const Vec3 normal = glm::normalize(hasNormal ? at.normal : glm::cross(shape.e1, shape.e2));
    const BsdfParameters p = bsdfParameters(scene, material, at);
    const DielectricFresnel fresnel{p.f0, p.specular, 1.0};
    const double through = 1.0 - maxComponent(fresnel(std::abs(glm::dot(normal, direction))));
    return (1.0 - p.metallic) * transmissionAt(scene, material, at) * through * p.baseColor;
}

} // namespace

bool isClearSheet(const Material& m) {
    const double roughness = m.roughness;
    return m.isThin && m.transmission > 0.0f && roughness * roughness <= kMinAlpha;
}

bool letsPass(const Material& m) {
    return m.alphaMode != AlphaMode::Opaque || isClearSheet(m);
}

Passing passingAt(const Scene& scene, const TriangleShape& shape, const Ray& ray, const Hit& hit) {
    const Triangle& triangle = scene.triangles[hit.triangle];
    const Material& material = scene.materials[triangle.material];
    if (!letsPass(material)) return {};
    const Interpolated at = interpolate(scene, triangle, {hit.u, hit.v});
    Passing passing;
    passing.coverage = coverageAt(scene, material, at);
    passing.share = Vec3(1.0 - passing.coverage);
    if (passing.coverage > 0.0 && isClearSheet(material))
        passing.share += passing.coverage * throughClearSheet(scene, material, at, shape, ray.direction);
    return passing;
}

} // namespace irradia::reference
