#include "tests/support/light_scenes.h"

#include "tests/reference/random.h"
#include "tests/reference/simple_scenes.h"

namespace irradia::test {

Environment skyWithSun(int width, int height) {
    reference::Random random(21);
    Environment sky;
    sky.width = width;
    sky.height = height;
    for (int i = 0; i < width * height; ++i)
        sky.texels.emplace_back(glm::vec3(0.2, 0.4, 0.9) * static_cast<float>(random.uniform()));
    sky.texels[static_cast<size_t>(height / 4 * width + width / 3)] = {900.0f, 800.0f, 600.0f};
    return sky;
}

Scene manyEmitters(int count) {
    reference::Random random(22);
    Scene scene;
    for (int i = 0; i < count; ++i) {
        Material light = reference::lambert(glm::vec3(0.5f), {5.0 * random.uniform(), 0.0, i + 1.0});
        light.doubleSided = i % 3 == 0;
        const uint32_t material = reference::addMaterial(scene, light);
        const glm::dvec3 d = reference::direction(2.0 * random.uniform() - 1.0, 6.28 * random.uniform());
        const reference::Frame frame(-d); // fronts face the origin
        const double size = 0.02 + 0.3 * random.uniform();
        const double turn = 6.28 * random.uniform();
        const glm::dvec3 a = std::cos(turn) * frame.tangent + std::sin(turn) * frame.bitangent;
        const glm::dvec3 b = glm::cross(frame.normal, a) + 0.3 * frame.normal;
        const auto first = static_cast<uint32_t>(scene.vertices.size());
        for (const glm::dvec3& p : {2.0 * d, 2.0 * d + size * a, 2.0 * d + size * b}) {
            Vertex vertex;
            vertex.position = glm::vec3(p);
            vertex.normal = glm::vec3(-d);
            scene.vertices.push_back(vertex);
        }
        scene.triangles.push_back({glm::uvec3(first, first + 1, first + 2), material});
    }
    return scene;
}

void addPunctualLights(Scene& scene, int points, int spots, int directional) {
    reference::Random random(23);
    const auto anyDirection = [&] {
        return glm::vec3(reference::direction(2.0 * random.uniform() - 1.0, 6.28 * random.uniform()));
    };
    for (int i = 0; i < points + spots + directional; ++i) {
        PunctualLight light;
        light.kind = i < points           ? PunctualLight::Kind::Point
                     : i < points + spots ? PunctualLight::Kind::Spot
                                          : PunctualLight::Kind::Directional;
        light.position = static_cast<float>(1.0 + random.uniform()) * anyDirection();
        light.direction = glm::normalize(anyDirection() - light.position); // most see the origin
        light.intensity = glm::vec3(random.uniform(), random.uniform(), random.uniform());
        light.outerAngle = static_cast<float>(0.2 + 1.3 * random.uniform());
        light.innerAngle = light.outerAngle * static_cast<float>(random.uniform());
        if (i % 7 == 3) light.intensity = glm::vec3(0.0f);
        scene.lights.push_back(light);
    }
}

} // namespace irradia::test
