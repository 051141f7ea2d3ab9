// How paths get at a cache: the host's side of shaders/path/taps/radiance_cache.
#pragma once

#include "engine/path/wavefront_path_tracer.h"
#include "shared/cache.h"

namespace irradia {

// What a wave's paths write, laid out in shaders/shared/cache.h.
struct CachePaths {
    BufferRange queries;          // rows for every path of a wave
    BufferRange queryWeights;     // a quad each
    BufferRange counters;         // kCacheCounters words
    BufferRange trainingPaths;    // those of the wave, from rule.firstTraining on
    BufferRange trainingVertices; // likewise, kMaxTrainingVertices each
    BufferRange trainingQueries;  // a row each
    gpu::CacheRule rule;
};

class CacheTap {
public:
    explicit CacheTap(Device& device);

    // For the next wave that the tracer traces; a rule without tiles has its paths followed no further than
    // the picture's.
    PathTap listen(WavefrontPathTracer& tracer, const CachePaths& paths) const;

private:
    Buffer rule_; // gpu::CacheRule
};

} // namespace irradia
