#include "nrc/cache/cache_queries.h"

#include "kernels/cache.h"

namespace irradia {

CacheQueries::CacheQueries(Device& device, uint32_t queries)
    : queries_(queries)
    , rows_(paddedRows(queries))
    , inputs_(device, "cache queries", rows_ * uint64_t{gpu::kCacheInputBytes})
    , weights_(device, "query weights", uint64_t{rows_} * 16)
    , counters_(device, "cache counters", gpu::kCacheCounters * 4)
    , resolveQueries_(device, kernels::resolve_queries) {}

std::vector<Device::PlannedBuffer> CacheQueries::planned(uint32_t queries) {
    const uint64_t rows = paddedRows(queries);
    return {{"cache queries", rows * gpu::kCacheInputBytes}, {"query weights", rows * 16}};
}

void CacheQueries::begin(FrameGraph& graph) {
    graph.fill({counters_, gpu::kQueryCounter * 4, 4}, 0);
}

void CacheQueries::resolve(FrameGraph& graph, BufferRange predictions, BufferRange state, bool reflectance,
                           BufferRange radiance) const {
    graph.pass(resolveQueries_)
        .readWrite(counters_)
        .read(inputs_)
        .read(weights_)
        .read(predictions)
        .read(state)
        .readWrite(radiance)
        .push(gpu::ResolveParams{reflectance ? 1u : 0u})
        .dispatch(queries_);
}

} // namespace irradia
