#include "nrc/samplers/surface_paths.h"

#include <algorithm>
#include <cmath>

namespace irradia {
namespace {

// How far away those are who see the surfaces: the mean chord of a convex body is 4 V / S (Cauchy).
float meanChord(const Bounds& box) {
    const glm::vec3 e = box.upper - box.lower;
    return 2.0f * e.x * e.y * e.z / std::max(e.x * e.y + e.y * e.z + e.z * e.x, 1e-30f);
}

} // namespace

SurfacePaths::SurfacePaths(const Bounds& bounds, uint32_t most)
    : distance_(meanChord(bounds))
    , most_(most) {}

void SurfacePaths::choose(double paths) {
    count_ = std::min(static_cast<uint32_t>(std::max(paths, 0.0)), most_);
}

void SurfacePaths::trace(WavefrontPathTracer& tracer, const CacheTap& tap, const gpu::CacheRule& rule,
                         uint32_t first) const {
    for (Waves waves = tracer.surfaceWaves(count_, tap.mostUnseen()); const auto wave = waves.next();) {
        tracer.traceSurfaceWave(*wave, distance_, tap.listenUnseen(tracer, rule, first, *wave));
        first += wave->paths();
    }
}

} // namespace irradia
