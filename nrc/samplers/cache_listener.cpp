#include "nrc/samplers/cache_listener.h"

namespace irradia {
namespace {

BufferRange ofPaths(const BufferRange& all, uint64_t bytes, uint64_t first, uint64_t paths) {
    return {*all.buffer, all.offset + first * bytes, paths * bytes};
}

} // namespace

CacheListener::CacheListener(Device& device)
    : rule_(device, "cache rule", sizeof(gpu::CacheRule))
    // The range that is bound begins at a whole tile of rows.
    , mostUnseen_(device.limits().maxStorageBufferRange / gpu::kVertexBytes - gpu::kTileRows) {}

PathTap CacheListener::listen(WavefrontPathTracer& tracer, const CacheTap& cache, gpu::CacheRule rule,
                              const RowRange& training) const {
    rule.firstTraining = training.first / gpu::kTileRows * gpu::kTileRows;
    const uint64_t first = rule.firstTraining, paths = training.first + training.rows - first;
    tracer.graph().update(rule_, rule);
    PathTap tap;
    tap.light = {{tracer.pathStates(), true, true},
                 {ofPaths(cache.trainingPaths, gpu::kTrainingPathBytes, first, paths), true, true},
                 {ofPaths(cache.trainingVertices, gpu::kVertexBytes, first, paths), true, true}};
    tap.vertex = {{cache.queries, false, true},         {cache.queryWeights, false, true},
                  {cache.trainingQueries, false, true}, {cache.counters, true, true},
                  {tracer.radiance(), true, true},      {rule_, true, false}};
    if (rule.tilesX > 0) tap.lastDepth = rule.lastDepth;
    return tap;
}

PathTap CacheListener::listenUnseen(WavefrontPathTracer& tracer, const CacheTap& cache, gpu::CacheRule rule,
                                    uint32_t first, uint32_t paths) const {
    rule.waveTraining = first;
    return listen(tracer, cache, rule, {first, paths});
}

} // namespace irradia
