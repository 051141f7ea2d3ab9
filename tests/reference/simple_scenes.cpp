#include "tests/reference/simple_scenes.h"
#include <cmath>
#include <numbers>

namespace irradia::reference {

namespace {

void addTriangle(Scene& scene, uint32_t material, const Vertex& a, const Vertex& b, const Vertex& c) {
    const auto first = static_cast<uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), {a, b, c});
    scene.triangles.push_back({{first, first + 1, first + 2}, material});
}

// A block standing on y = -1, turned about its vertical axis.
void addBlock(Scene& scene, uint32_t material, const glm::vec2& centre, float half, float height,
              float angle) {
    const glm::vec3 a(half * std::cos(angle), 0.0f, half * std::sin(angle)), b(-a.z, 0.0f, a.x);
    const glm::vec3 base(centre.x, -1.0f, centre.y), up(0.0f, height, 0.0f);
    addQuad(scene, material, base + up - a - b, 2.0f * b, 2.0f * a);
    addQuad(scene, material, base - a - b, up, 2.0f * a);
    addQuad(scene, material, base + a - b, up, 2.0f * b);
    addQuad(scene, material, base + a + b, up, -2.0f * a);
    addQuad(scene, material, base - a + b, up, -2.0f * b);
}

} // namespace

Material lambert(const glm::vec3& albedo, const glm::vec3& emission) {
    Material material;
    material.baseColor = albedo;
    material.emission = emission;
    material.metallic = 0.0f;
    material.specular = 0.0f;
    return material;
}

uint32_t addMaterial(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return static_cast<uint32_t>(scene.materials.size() - 1);
}

void addQuad(Scene& scene, uint32_t material, const glm::vec3& corner, const glm::vec3& a,
             const glm::vec3& b) {
    const glm::vec3 normal = glm::normalize(glm::cross(a, b));
    const auto vertex = [&](float u, float v) {
        Vertex result;
        result.position = corner + u * a + v * b;
        result.normal = normal;
        result.tangent = glm::vec4(glm::normalize(a), 1.0f);
        result.uv[0] = result.uv[1] = {u, v};
        return result;
    };
    addTriangle(scene, material, vertex(0, 0), vertex(1, 0), vertex(1, 1));
    addTriangle(scene, material, vertex(0, 0), vertex(1, 1), vertex(0, 1));
}

void addSphereFromInside(Scene& scene, uint32_t material, const glm::vec3& centre, float radius, int rings) {
    const int sectors = 2 * rings;
    const float step = std::numbers::pi_v<float> / static_cast<float>(rings);
    const auto point = [&](int ring, int sector) {
        const float polar = step * static_cast<float>(ring),
                    azimuth = step * static_cast<float>(sector % sectors);
        if (ring == 0 || ring == rings) return centre + glm::vec3(0.0f, ring == 0 ? radius : -radius, 0.0f);
        return centre + radius * glm::vec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                           std::sin(polar) * std::sin(azimuth));
    };
    const auto flat = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        const auto vertex = [&](const glm::vec3& position) {
            Vertex result;
            result.position = position;
            result.normal = normal;
            return result;
        };
        addTriangle(scene, material, vertex(a), vertex(b), vertex(c));
    };
    for (int ring = 0; ring < rings; ++ring)
        for (int sector = 0; sector < sectors; ++sector) {
            const glm::vec3 a = point(ring, sector), b = point(ring, sector + 1);
            const glm::vec3 c = point(ring + 1, sector), d = point(ring + 1, sector + 1);
            if (ring > 0) flat(a, d, b);
            if (ring < rings - 1)
                flat(a, c, d);
            else if (rings == 1)
                flat(a, c, b);
        }
}

Scene smallBox() {
    Scene scene;
    const uint32_t white = addMaterial(scene, lambert(glm::vec3(0.73f)));
    const uint32_t red = addMaterial(scene, lambert({0.63f, 0.06f, 0.05f}));
    const uint32_t green = addMaterial(scene, lambert({0.14f, 0.45f, 0.09f}));
    const uint32_t lamp = addMaterial(scene, lambert(glm::vec3(0.0f), {17.0f, 12.0f, 4.0f}));
    Material metal;
    metal.baseColor = {0.9f, 0.6f, 0.3f};
    metal.roughness = 0.4f;
    Material polished;
    polished.baseColor = glm::vec3(0.5f);
    polished.metallic = 0.0f;
    polished.roughness = 0.2f;
    const uint32_t metalIndex = addMaterial(scene, metal), floorIndex = addMaterial(scene, polished);

    addQuad(scene, floorIndex, {-1, -1, 1}, {2, 0, 0}, {0, 0, -2});
    addQuad(scene, white, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
    addQuad(scene, white, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
    addQuad(scene, red, {-1, -1, 1}, {0, 0, -2}, {0, 2, 0});
    addQuad(scene, green, {1, -1, -1}, {0, 0, 2}, {0, 2, 0});
    addQuad(scene, lamp, {-0.25f, 0.99f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f});
    addBlock(scene, metalIndex, {-0.35f, -0.3f}, 0.28f, 1.2f, 0.3f);
    addBlock(scene, white, {0.35f, 0.3f}, 0.28f, 0.6f, -0.3f);
    scene.cameras.push_back(lookAt({0.0f, 0.0f, 3.8f}, glm::vec3(0.0f), 0.68f));
    return scene;
}

Camera lookAt(const glm::vec3& position, const glm::vec3& target, float verticalFov) {
    Camera camera;
    camera.position = position;
    camera.forward = glm::normalize(target - position);
    const glm::vec3 world = std::abs(camera.forward.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    camera.up = glm::normalize(world - glm::dot(world, camera.forward) * camera.forward);
    camera.verticalFov = verticalFov;
    return camera;
}

} // namespace irradia::reference
