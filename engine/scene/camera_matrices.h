// A camera as OpenEXR's standard attributes describe it (ImfStandardAttributes.h).
#pragma once

#include "engine/scene/scene.h"

namespace irradia {

// World to camera: x to the right, y up and z along the view (left-handed, as RenderMan's). The camera's
// position is relative to `origin`.
glm::mat4 worldToCamera(const Camera& camera, const glm::dvec3& origin = glm::dvec3(0.0));
// World to the picture: (0, 0) is its upper left corner, (1, 1) its lower right. z is one over the depth,
// of an orthographic camera the depth.
glm::mat4 worldToNdc(const Camera& camera, float aspect, const glm::dvec3& origin = glm::dvec3(0.0));

} // namespace irradia
