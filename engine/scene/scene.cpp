#include "engine/scene/scene.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace irradia {

Bounds sceneBounds(const Scene& scene) {
    if (scene.triangles.empty()) return {};
    const glm::vec3 first = scene.vertices[scene.triangles.front().vertex.x].position;
    Bounds bounds{first, first};
    for (const Triangle& triangle : scene.triangles)
        for (int c = 0; c < 3; ++c) {
            const glm::vec3 corner = scene.vertices[triangle.vertex[c]].position;
            bounds.lower = glm::min(bounds.lower, corner);
            bounds.upper = glm::max(bounds.upper, corner);
        }
    return bounds;
}

Camera framingCamera(const Bounds& bounds) {
    const glm::vec3 centre = 0.5f * (bounds.lower + bounds.upper);
    const float radius = 0.5f * glm::length(bounds.upper - bounds.lower);
    Camera camera;
    camera.name = "framing";
    camera.verticalFov = glm::radians(40.0f);
    // The bounding sphere touches the upper and lower edge of the picture.
    const float distance = (radius > 0 ? radius : 1.0f) / std::sin(0.5f * camera.verticalFov);
    const float elevation = glm::radians(15.0f);
    camera.forward = {0.0f, -std::sin(elevation), -std::cos(elevation)};
    camera.up = {0.0f, std::cos(elevation), -std::sin(elevation)};
    camera.position = centre - distance * camera.forward;
    return camera;
}

} // namespace irradia
