// Primary rays of a pinhole or orthographic camera with a box filter over the pixel.
#pragma once

#include "engine/scene/scene.h"
#include "tests/reference/bvh.h"

namespace irradia::reference {

class CameraRays {
public:
    CameraRays(const Camera& camera, int width, int height)
        : origin_(camera.position)
        , forward_(camera.forward)
        , parallel_(camera.halfHeight > 0.0f)
        , width_(width)
        , height_(height) {
        const double half = parallel_ ? static_cast<double>(camera.halfHeight)
                                      : std::tan(0.5 * static_cast<double>(camera.verticalFov));
        right_ = half * width / height * glm::cross(forward_, Vec3(camera.up));
        up_ = half * Vec3(camera.up);
    }

    // Through pixel (x, y), row 0 at the top, at jitter in [0, 1)^2 from its upper left corner.
    Ray through(int x, int y, const Vec2& jitter) const {
        const double right = 2.0 * (x + jitter.x) / width_ - 1.0, up = 1.0 - 2.0 * (y + jitter.y) / height_;
        if (parallel_) return {origin_ + right * right_ + up * up_, forward_};
        return {origin_, glm::normalize(forward_ + right * right_ + up * up_)};
    }

private:
    Vec3 origin_, forward_, right_{0.0}, up_{0.0};
    bool parallel_;
    int width_, height_;
};

} // namespace irradia::reference
