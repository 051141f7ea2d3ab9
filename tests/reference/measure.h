// The radiance from one point in one direction, by the reference path tracer.
#pragma once

#include "tests/reference/path_tracer.h"
#include "tests/reference/simple_scenes.h"
#include "tests/reference/z_test.h"

namespace irradia::reference {

struct Measured {
    Vec3 mean{0.0}, sigma{0.0};
};

// Radiance towards the eye through a pinhole of hardly any width.
inline Measured measure(const Scene& scene, const glm::vec3& eye, const glm::vec3& target, int maxBounces,
                        int samples, LightStrategy strategy = LightStrategy::Mis) {
    RenderSettings settings;
    settings.width = settings.height = 4; // 16 streams, for the threads
    settings.samples = samples / 16;
    settings.maxBounces = maxBounces;
    settings.strategy = strategy;
    const ImageEstimate image =
        blockMeans(PathTracer(scene).render(lookAt(eye, target, 1e-4f), settings), settings.width);
    return {image.mean[0], glm::sqrt(image.variance[0])};
}

} // namespace irradia::reference
