#include "nrc/samplers/cache_tap.h"

namespace irradia {
namespace {

BufferRange ofPaths(const BufferRange& all, uint64_t bytes, uint64_t first, uint64_t paths) {
    return {*all.buffer, all.offset + first * bytes, paths * bytes};
}

} // namespace

CacheTap::CacheTap(Device& device, const CacheBuffers& buffers)
    : buffers_(buffers)
    // The range that is bound begins at a whole tile of rows.
    , mostUnseen_(device.limits().maxStorageBufferRange / gpu::kVertexBytes - gpu::kTileRows)
    , rule_(device, "cache rule", sizeof(gpu::CacheRule)) {}

PathTap CacheTap::listen(WavefrontPathTracer& tracer, gpu::CacheRule rule, const RowRange& training) const {
    const CacheBuffers& b = buffers_;
    rule.firstTraining = training.first / gpu::kTileRows * gpu::kTileRows;
    const uint64_t first = rule.firstTraining, paths = training.first + training.rows - first;
    tracer.graph().update(rule_, rule);
    PathTap tap;
    tap.light = {{tracer.pathStates(), true, true},
                 {ofPaths(b.trainingPaths, gpu::kTrainingPathBytes, first, paths), true, true},
                 {ofPaths(b.trainingVertices, gpu::kVertexBytes, first, paths), true, true}};
    tap.vertex = {{b.queries, false, true}, {b.queryWeights, false, true},   {b.trainingQueries, false, true},
                  {b.counters, true, true}, {tracer.radiance(), true, true}, {rule_, true, false}};
    if (rule.tilesX > 0) tap.lastDepth = rule.lastDepth;
    return tap;
}

PathTap CacheTap::listenUnseen(WavefrontPathTracer& tracer, gpu::CacheRule rule, uint32_t first,
                               const Wave& wave) const {
    rule.waveTraining = first;
    return listen(tracer, rule, {first, wave.paths()});
}

} // namespace irradia
