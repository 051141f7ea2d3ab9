#include "tests/reference/glass_scenes.h"
#include "tests/reference/simple_scenes.h"
#include <cmath>

namespace irradia::reference {

namespace {

// Floor, walls and camera of a room; white but for the red left and the green right wall.
Scene roomWithoutCeiling() {
    Scene scene;
    const uint32_t white = addMaterial(scene, lambert(glm::vec3(0.7f)));
    const uint32_t red = addMaterial(scene, lambert({0.6f, 0.15f, 0.1f}));
    const uint32_t green = addMaterial(scene, lambert({0.15f, 0.5f, 0.2f}));
    addQuad(scene, white, {-1, -1, 1}, {2, 0, 0}, {0, 0, -2});
    addQuad(scene, white, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
    addQuad(scene, white, {1, -1, 1}, {-2, 0, 0}, {0, 2, 0});
    addQuad(scene, red, {-1, -1, 1}, {0, 0, -2}, {0, 2, 0});
    addQuad(scene, green, {1, -1, -1}, {0, 0, 2}, {0, 2, 0});
    scene.cameras.push_back(lookAt({0.0f, 0.1f, 0.95f}, {0.0f, -0.15f, -0.2f}, 1.3f));
    return scene;
}

Scene closedRoom() {
    Scene scene = roomWithoutCeiling();
    addQuad(scene, 0, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
    const uint32_t lamp = addMaterial(scene, lambert(glm::vec3(0.0f), {2.0f, 1.8f, 1.5f}));
    addQuad(scene, lamp, {-0.8f, 0.99f, -0.8f}, {1.6f, 0, 0}, {0, 0, 1.6f});
    return scene;
}

// 4x4 texels: a colour from corner to corner, and an alpha of which a third is open.
TextureImage screenPicture() {
    TextureImage picture{"", 4, 4, {}};
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            const int alpha[] = {20, 120, 255};
            const int rgba[] = {255 - 40 * x, 150 + 30 * y, 120 + 15 * (x + y), alpha[(x + 2 * y) % 3]};
            for (const int value : rgba) picture.rgba.push_back(static_cast<uint8_t>(value));
        }
    return picture;
}

// Turned by 0.4 rad, two thirds as large, moved.
glm::mat3x2 turned() {
    const float c = 1.5f * std::cos(0.4f), s = 1.5f * std::sin(0.4f);
    return {c, -s, s, c, 0.3f, -0.2f};
}

void colourVertices(Scene& scene, size_t first) {
    const glm::vec4 colours[] = {{1, 0.5f, 0.5f, 1}, {0.5f, 1, 0.5f, 0.8f}, {0.4f, 0.6f, 1, 0.6f}};
    for (size_t i = first; i < scene.vertices.size(); ++i) scene.vertices[i].color = colours[i % 3];
}

} // namespace

Material solidGlass(float ior, float roughness) {
    Material glass = glassSheet(roughness);
    glass.ior = ior;
    glass.isThin = false;
    return glass;
}

Material glassSheet(float roughness) {
    Material glass;
    glass.metallic = 0.0f;
    glass.roughness = roughness;
    glass.transmission = 1.0f;
    return glass;
}

void addSphere(Scene& scene, uint32_t material, const glm::vec3& centre, float radius, int rings,
               bool isSmooth) {
    const size_t triangles = scene.triangles.size(), vertices = scene.vertices.size();
    addSphereFromInside(scene, material, centre, radius, rings);
    for (size_t i = triangles; i < scene.triangles.size(); ++i)
        std::swap(scene.triangles[i].vertex.y, scene.triangles[i].vertex.z);
    for (size_t i = vertices; i < scene.vertices.size(); ++i) {
        Vertex& v = scene.vertices[i];
        v.normal = isSmooth ? glm::normalize(v.position - centre) : -v.normal;
    }
}

void addCuboid(Scene& scene, uint32_t material, const glm::vec3& lower, const glm::vec3& upper) {
    const glm::vec3 size = upper - lower;
    const glm::vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    addQuad(scene, material, lower, y, x);
    addQuad(scene, material, lower, z, y);
    addQuad(scene, material, lower, x, z);
    addQuad(scene, material, lower + z, x, y);
    addQuad(scene, material, lower + x, y, z);
    addQuad(scene, material, lower + y, z, x);
}

Scene glassBall(bool isSmooth) {
    Scene scene = closedRoom();
    const uint32_t glass = addMaterial(scene, solidGlass(1.5f, 0.0f));
    addSphere(scene, glass, {0.05f, -0.4f, -0.2f}, 0.55f, 12, isSmooth);
    return scene;
}

Scene roughSlab() {
    Scene scene = closedRoom();
    Material glass = solidGlass(1.4f, 0.45f);
    glass.baseColor = {0.95f, 0.8f, 0.6f};
    glass.absorption = {0.2f, 0.6f, 1.5f};
    const uint32_t slab = addMaterial(scene, glass);
    addCuboid(scene, slab, {-0.6f, -0.95f, -0.4f}, {0.6f, 0.3f, -0.1f});
    return scene;
}

Scene nestedBalls() {
    Scene scene = closedRoom();
    Material core = solidGlass(1.8f, 0.3f);
    core.absorption = {3.0f, 0.8f, 0.3f};
    const uint32_t outer = addMaterial(scene, solidGlass(1.33f, 0.0f));
    const uint32_t inner = addMaterial(scene, core);
    addSphere(scene, outer, {0.0f, -0.3f, -0.2f}, 0.6f, 12, true);
    addSphere(scene, inner, {0.05f, -0.35f, -0.2f}, 0.3f, 8, false);
    return scene;
}

Scene screens() {
    Scene scene = closedRoom();
    scene.images.push_back(screenPicture());
    Material screen = lambert(glm::vec3(0.9f));
    screen.baseColorTexture.image = 0;
    screen.baseColorTexture.transform = turned();
    screen.alphaMode = AlphaMode::Blend;
    screen.alpha = 0.8f;
    const size_t coloured = scene.vertices.size();
    addQuad(scene, addMaterial(scene, screen), {-0.9f, -0.9f, -0.5f}, {0.9f, 0, 0.2f}, {0, 1.2f, 0});
    colourVertices(scene, coloured);

    screen.alphaMode = AlphaMode::Mask;
    screen.alpha = 1.0f;
    screen.alphaCutoff = 0.4f;
    screen.specular = 1.0f;
    screen.roughness = 0.5f;
    addQuad(scene, addMaterial(scene, screen), {0.1f, -0.9f, -0.3f}, {0.8f, 0, -0.2f}, {0, 1.2f, 0});

    Material clear = glassSheet(0.0f), frosted = glassSheet(0.5f), unlit = lambert(glm::vec3(0.0f));
    clear.baseColor = {0.5f, 0.8f, 0.95f};
    clear.transmission = 0.8f;
    frosted.transmissionTexture.image = 0;
    unlit.emission = {0.4f, 0.5f, 0.6f};
    unlit.isUnlit = unlit.doubleSided = true;
    addQuad(scene, addMaterial(scene, clear), {-0.7f, -0.8f, 0.1f}, {0.6f, 0, 0.1f}, {0, 0.8f, 0});
    addQuad(scene, addMaterial(scene, frosted), {0.1f, -0.8f, 0.2f}, {0.5f, 0, 0}, {0, 0.7f, 0});
    const size_t glowing = scene.vertices.size();
    addQuad(scene, addMaterial(scene, unlit), {-0.4f, 0.4f, -0.8f}, {0.8f, 0, 0}, {0, 0.3f, 0.1f});
    colourVertices(scene, glowing);
    return scene;
}

Scene punctualRoom() {
    Scene scene = roomWithoutCeiling();
    Material polished;
    polished.baseColor = {0.6f, 0.55f, 0.5f};
    polished.metallic = 0.0f;
    polished.roughness = 0.0f;
    Material metal;
    metal.baseColor = {0.9f, 0.6f, 0.3f};
    metal.roughness = 0.4f;
    addCuboid(scene, addMaterial(scene, metal), {-0.7f, -1.0f, -0.6f}, {-0.2f, 0.1f, -0.1f});
    addCuboid(scene, addMaterial(scene, polished), {0.2f, -1.0f, -0.3f}, {0.7f, -0.4f, 0.2f});
    using Kind = PunctualLight::Kind;
    PunctualLight point{"", Kind::Point, {0.6f, 0.5f, 0.3f}};
    point.intensity = {0.5f, 0.45f, 0.4f};
    point.range = 3.0f;
    PunctualLight spot{"", Kind::Spot, {-0.7f, 0.8f, 0.6f}};
    spot.direction = glm::normalize(glm::vec3(0.6f, -1.3f, -0.9f));
    spot.intensity = {1.0f, 1.4f, 2.0f};
    spot.innerAngle = 0.2f, spot.outerAngle = 0.5f;
    PunctualLight sun{"", Kind::Directional};
    sun.direction = glm::normalize(glm::vec3(0.3f, -1.0f, -0.2f));
    sun.intensity = {0.9f, 0.8f, 0.6f};
    scene.lights = {point, spot, sun};
    return scene;
}

} // namespace irradia::reference
