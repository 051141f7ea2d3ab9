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
    const bool parallel = camera.isOrthographic();
    const double height = // of the picture; of a pinhole's at depth 1
        2.0 * (parallel ? double(camera.halfHeight) : std::tan(0.5 * double(camera.verticalFov)));
    const double x = 1.0 / (height * double(aspect)), y = -1.0 / height;
    const glm::dvec4 depth(0.0, 0.0, 1.0, 0.0), one(0.0, 0.0, 0.0, 1.0);
    const glm::dmat4 rows = parallel
                                ? glm::dmat4(glm::dvec4(x, 0.0, 0.0, 0.5), glm::dvec4(0.0, y, 0.0, 0.5), //
                                             depth, one)
                                : glm::dmat4(glm::dvec4(x, 0.0, 0.5, 0.0), glm::dvec4(0.0, y, 0.5, 0.0), //
                                             one, depth);
    return glm::transpose(rows) * exactWorldToCamera(camera, origin);
}

} // namespace irradia
