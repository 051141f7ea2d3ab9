// Who listens at paths' vertices for a cache: the host's side of shaders/path/taps/radiance_cache.
#pragma once

#include "engine/path/wavefront_path_tracer.h"
#include "nrc/cache/cache.h"
#include "nrc/learning/batch_rows.h"

namespace irradia {

class CacheListener {
public:
    explicit CacheListener(Device& device);

    // For the next wave that the tracer traces, which may write these training paths. A rule without tiles
    // has paths followed no further than the picture's.
    PathTap listen(WavefrontPathTracer& tracer, const CacheTap& cache, gpu::CacheRule rule,
                   const RowRange& training) const;
    // To a wave that is not seen, and whose path k is training path `first` + k.
    PathTap listenUnseen(WavefrontPathTracer& tracer, const CacheTap& cache, gpu::CacheRule rule,
                         uint32_t first, uint32_t paths) const;
    // Paths of such a wave at most: one binding holds their vertices.
    uint32_t mostUnseen() const { return mostUnseen_; }

private:
    Buffer rule_; // gpu::CacheRule
    uint32_t mostUnseen_;
};

} // namespace irradia
