// How paths get at a cache: the host's side of shaders/path/taps/radiance_cache.
#pragma once

#include "engine/path/wavefront_path_tracer.h"
#include "nrc/cache/cache.h"
#include "nrc/learning/batch_rows.h"

namespace irradia {

class CacheTap {
public:
    CacheTap(Device& device, const CacheBuffers& buffers);

    // For the next wave that the tracer traces, whose paths may write these training paths; a rule without
    // tiles has them followed no further than the picture's.
    PathTap listen(WavefrontPathTracer& tracer, gpu::CacheRule rule, const RowRange& training) const;
    // The same for a wave that is not seen, and whose path k is training path `first` + k.
    PathTap listenUnseen(WavefrontPathTracer& tracer, gpu::CacheRule rule, uint32_t first,
                         const Wave& wave) const;
    // Paths of such a wave at most, whose vertices one binding holds.
    uint32_t mostUnseen() const { return mostUnseen_; }

private:
    CacheBuffers buffers_;
    uint32_t mostUnseen_;
    Buffer rule_; // gpu::CacheRule
};

} // namespace irradia
