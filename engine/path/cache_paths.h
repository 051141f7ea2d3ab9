// The buffers through which a path tracer asks a radiance cache and tells it what it has seen; laid out in
// shaders/shared/cache.h. Who owns them (nrc's RadianceCache, or a test) fills the rule too.
#pragma once

#include "engine/gpu/buffer.h"
#include "shared/cache.h"

namespace irradia {

struct CachePaths {
    BufferRange queries;          // rows for every path of a wave
    BufferRange queryWeights;     // a record each
    BufferRange counters;         // kCacheCounters words
    BufferRange trainingPaths;    // those of the wave, from rule.firstTraining on
    BufferRange trainingVertices; // likewise, kMaxTrainingVertices each
    BufferRange trainingQueries;  // a row each
    gpu::CacheRule rule;
};

} // namespace irradia
