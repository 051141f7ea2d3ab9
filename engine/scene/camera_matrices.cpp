#include "engine/scene/camera_matrices.h"

#include <cmath>

namespace irradia {
namespace {

glm::dmat4 exactWorldToCamera(const Camera& camera, const glm::dvec3& origin) {
    const glm::dvec3 forward = camera.forward, up = camera.up;
    const glm::dvec3 position = origin + glm::dvec3(camera.position);
    const glm::dvec3 right = glm::cross(forward, up);
    const glm::dmat4 rows(glm::dvec4(right, -glm::dot(right, position)),
                          glm::dvec4(up, -glm::dot(up, position)),
                          glm::dvec4(forward, -glm::dot(forward, position)), glm::dvec4(0, 0, 0, 1));
    return glm::transpose(rows);
}

} // namespace

glm::mat4 worldToCamera(const Camera& camera, const glm::dvec3& origin) {
    return exactWorldToCamera(camera, origin);
}

glm::mat4 worldToNdc(const Camera& camera, float aspect, const glm::dvec3& origin) {
    const double height = 2.0 * std::tan(0.5 * double(camera.verticalFov)); // of the picture, at depth 1
    const glm::dmat4 rows(glm::dvec4(1.0 / (height * double(aspect)), 0.0, 0.5, 0.0),
                          glm::dvec4(0.0, -1.0 / height, 0.5, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0),
                          glm::dvec4(0.0, 0.0, 1.0, 0.0));
    return glm::transpose(rows) * exactWorldToCamera(camera, origin);
}

} // namespace irradia
