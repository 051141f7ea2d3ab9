#include "tests/reference/lights.h"
#include "tests/reference/texture.h"

namespace irradia::reference {

namespace {

// Luminance of each material's mean emission, both sides together.
std::vector<double> emissionByMaterial(const Scene& scene) {
    std::vector<double> emission;
    for (const Material& m : scene.materials) {
        const bool isDark = m.emission == glm::vec3(0.0f);
        const Vec3 mean = isDark ? Vec3(0.0) : meanColor(scene, m.emissiveTexture, Encoding::Srgb);
        emission.push_back((m.doubleSided ? 2.0 : 1.0) * luminance(Vec3(m.emission) * mean));
    }
    return emission;
}

std::vector<double> powers(const Scene& scene, const std::vector<TriangleShape>& shapes) {
    const std::vector<double> emission = emissionByMaterial(scene);
    std::vector<double> power;
    for (size_t i = 0; i < shapes.size(); ++i)
        power.push_back(emission[scene.triangles[i].material] *
                        glm::length(glm::cross(shapes[i].e1, shapes[i].e2)));
    return power;
}

} // namespace

Lights::Lights(const Scene& scene)
    : scene_(&scene)
    , shapes_(triangleShapes(scene))
    , triangles_(powers(scene, shapes_))
    , environment_(scene.environment) {
    const bool hasTriangles = triangles_.total() > 0.0, hasEnvironment = !environment_.isBlack();
    environmentShare_ = hasTriangles && hasEnvironment ? 0.5 : hasEnvironment ? 1.0 : 0.0;
}

LightSample Lights::sample(const Vec3& receiver, Random& random) const {
    if (environmentShare_ > 0.0 && random.uniform() < environmentShare_) {
        const Vec3 direction = environment_.sample(random.uniform2());
        return {direction, 1e300, environment_.radiance(direction), environmentPdf(direction)};
    }
    return triangles_.total() > 0.0 ? sampleTriangle(receiver, random) : LightSample{};
}

LightSample Lights::sampleTriangle(const Vec3& receiver, Random& random) const {
    const auto [index, unused] = triangles_.sample(random.uniform());
    const auto triangle = static_cast<uint32_t>(index);
    const TriangleShape& shape = shapes_[triangle];
    const Vec2 r = random.uniform2();
    const double root = std::sqrt(r.x); // Osada et al. 2002, "Shape distributions", eq. 1
    const Vec2 uv(root * (1.0 - r.y), root * r.y);
    const Vec3 toLight = shape.p0 + uv.x * shape.e1 + uv.y * shape.e2 - receiver;
    LightSample sample;
    sample.distance = glm::length(toLight);
    if (sample.distance == 0.0) return {};
    sample.direction = toLight / sample.distance;
    const bool front = glm::dot(glm::cross(shape.e1, shape.e2), sample.direction) < 0.0;
    sample.radiance = emittedRadiance(*scene_, triangle, uv, front);
    sample.pdf = trianglePdf(triangle, sample.direction, sample.distance);
    return sample;
}

double Lights::trianglePdf(uint32_t triangle, const Vec3& direction, double distance) const {
    if (!(triangles_.total() > 0.0)) return 0.0;
    return trianglePdf(triangle, direction, distance, triangles_.probability(triangle));
}

double Lights::trianglePdf(uint32_t triangle, const Vec3& direction, double distance, double chance) const {
    const TriangleShape& shape = shapes_[triangle];
    // chance / area * distance^2 / cosine, with cross(e1, e2) = 2 area N
    const double projectedArea = 0.5 * std::abs(glm::dot(glm::cross(shape.e1, shape.e2), direction));
    if (projectedArea == 0.0) return 0.0;
    return (1.0 - environmentShare_) * chance * distance * distance / projectedArea;
}

double Lights::environmentPdf(const Vec3& direction) const {
    return environmentShare_ > 0.0 ? environmentShare_ * environment_.pdf(direction) : 0.0;
}

} // namespace irradia::reference
