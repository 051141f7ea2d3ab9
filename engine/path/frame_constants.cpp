#include "engine/path/frame_constants.h"

#include <cmath>

namespace irradia {
namespace {

gpu::CameraConstants cameraConstants(const Camera& camera, float aspect) {
    const float scale = camera.isOrthographic() ? camera.halfHeight : std::tan(0.5f * camera.verticalFov);
    const glm::vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
    return {glm::vec4(camera.position, camera.isOrthographic() ? 1 : 0), glm::vec4(camera.forward, 0),
            glm::vec4(right * scale * aspect, 0), glm::vec4(camera.up * scale, 0)};
}

} // namespace

FrameUniforms frameUniforms(const GpuScene& scene, const PathTracerOptions& options, const Camera& camera) {
    const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
    return {{options.seed, options.width, options.height, scene.triangles, scene.lightCount,
             scene.environmentWidth, scene.environmentHeight, scene.lightShares.environment,
             scene.lightShares.directional, scene.lightShares.local, scene.directionalCount,
             scene.firstPunctual},
            cameraConstants(camera, aspect)};
}

} // namespace irradia
