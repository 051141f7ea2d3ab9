// From training paths to records: where paths ended the cache predicts, light goes back along them, and their
// vertices become rows of inputs and targets side by side. Of use to any cache that learns from targets.
#pragma once

#include "engine/graph/frame_graph.h"
#include "nrc/learning/batch_rows.h"
#include "nrc/learning/trainer.h"
#include "shared/cache.h"
#include <functional>

namespace irradia {

struct PathRecordsOptions {
    uint32_t trainingPaths = 0; // of a frame at most
    uint32_t capacity = 0;      // records of a frame at most; of more, some spread evenly are left out
    bool factorise = false;     // predictions and targets are of radiance over reflectance
    float meanDecay = 0.95f;    // of the running mean of the targets' brightness, a frame
};

class PathRecords {
public:
    // `counters`: those of the cache's queries; `state`: gpu::CacheState, followed here.
    PathRecords(Device& device, const PathRecordsOptions& options, BufferRange counters, BufferRange state);
    static std::vector<Device::PlannedBuffer> planned(const PathRecordsOptions& options);

    // Training paths whose vertices become records together.
    static uint32_t pathsTogether(const PathRecordsOptions& options);

    void begin(FrameGraph& graph); // of a frame: no path has vertices

    // A quad for each of `rows` rows of inputs, at most pathsTogether() of them. Those below rows.first are
    // not asked for.
    using Predict = std::function<BufferRange(FrameGraph& graph, const RowCount& rows, BufferRange inputs)>;
    // Gathered light becomes the targets of training paths 0 to `paths` - 1.
    void propagate(FrameGraph& graph, uint32_t paths, const Predict& predict);
    // After it: the vertices' places, the targets' brightness and with it the scale, then the records.
    void write(FrameGraph& graph, uint32_t paths);

    Records records() const; // for Trainer::train

    const Buffer& paths() const { return paths_; }
    const Buffer& vertices() const { return vertices_; }
    const Buffer& queries() const { return queries_; } // where paths ended in the cache

private:
    BufferRange ofPart(const Buffer& all, const RowRange& part, uint64_t pathBytes) const;
    gpu::RecordsParams params(uint32_t paths) const;

    PathRecordsOptions options_;
    uint32_t pathRows_;
    BufferRange counters_, state_;
    Buffer paths_, vertices_, queries_;
    Buffer pathSums_, firstRecords_, inputs_, targets_;
    Kernel propagateTraining_, countRecords_, writeRecords_;
};

} // namespace irradia
