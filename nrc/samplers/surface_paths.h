// Training paths from points uniform over the scene's surfaces, so that what leaves the screen is not
// forgotten.
#pragma once

#include "nrc/samplers/cache_tap.h"

namespace irradia {

class SurfacePaths {
public:
    // In `bounds`, at most `most` a frame; where there are any, the scene's area table is packed.
    SurfacePaths(const Bounds& bounds, uint32_t most);

    void choose(double paths); // for the frames that follow, as many at most
    uint32_t count() const { return count_; }
    // From which they are seen: the mean chord of the bounds.
    float distance() const { return distance_; }

    // Traces them: training paths from number `first` on. All of such a path is suffix.
    void trace(WavefrontPathTracer& tracer, const CacheTap& tap, const gpu::CacheRule& rule,
               uint32_t first) const;

private:
    float distance_;
    uint32_t most_, count_ = 0;
};

} // namespace irradia
