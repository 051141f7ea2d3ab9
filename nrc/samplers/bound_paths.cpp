#include "nrc/samplers/bound_paths.h"

namespace irradia {
namespace {

BufferRange ofPaths(const BufferRange& all, uint64_t bytes, uint64_t first, uint64_t paths) {
    return {*all.buffer, all.offset + first * bytes, paths * bytes};
}

} // namespace

CachePaths boundPaths(const CacheTap& tap, gpu::CacheRule rule, const RowRange& training) {
    rule.firstTraining = training.first / gpu::kTileRows * gpu::kTileRows;
    const uint64_t paths = training.first + training.rows - rule.firstTraining;
    return {tap.queries,
            tap.queryWeights,
            tap.counters,
            ofPaths(tap.trainingPaths, gpu::kTrainingPathBytes, rule.firstTraining, paths),
            ofPaths(tap.trainingVertices, gpu::kVertexBytes, rule.firstTraining, paths),
            tap.trainingQueries,
            rule};
}

CachePaths unseenPaths(const CacheTap& tap, gpu::CacheRule rule, uint32_t first, uint32_t paths) {
    rule.waveTraining = first;
    return boundPaths(tap, rule, {first, paths});
}

} // namespace irradia
