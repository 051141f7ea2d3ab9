// The queries of a wave's paths, and how predictions are added to the paths' radiance: of use to any cache
// that predicts row by row.
#pragma once

#include "engine/graph/frame_graph.h"
#include "nrc/learning/batch_rows.h"
#include "nrc/learning/encoding.h"
#include "shared/cache.h"

namespace irradia {

class CacheQueries {
public:
    CacheQueries(Device& device, uint32_t queries); // of a wave at most
    static std::vector<Device::PlannedBuffer> planned(uint32_t queries);

    void begin(FrameGraph& graph); // of a wave: there are none
    RowCount rows() const { return {counters_, gpu::kQueryCounter, rows_}; }

    // `predictions`: a quad a row; `state`: gpu::CacheState, whose scale they have; `reflectance`: they are
    // multiplied by the vertex' reflectance.
    void resolve(FrameGraph& graph, BufferRange predictions, BufferRange state, bool reflectance,
                 BufferRange radiance) const;

    const Buffer& inputs() const { return inputs_; }
    const Buffer& weights() const { return weights_; }
    const Buffer& counters() const { return counters_; } // gpu::kCacheCounters words

private:
    uint32_t queries_, rows_;
    Buffer inputs_, weights_, counters_;
    Kernel resolveQueries_;
};

} // namespace irradia
