#include "nrc/cache/training_records.h"

#include "engine/error.h"
#include "kernels/cache.h"
#include "shared/network.h"
#include <algorithm>

namespace irradia {
namespace {

constexpr uint64_t kPathBytes = gpu::kTrainingPathBytes, kVertexBytes = gpu::kVertexBytes; // of products
constexpr uint64_t kInputBytes = gpu::kCacheInputBytes;

// Their range fits any device's binding, and one dispatch takes all of their vertices.
constexpr uint32_t kPathsTogether = 1u << 16;

template <typename Action>
void forEachPart(uint32_t paths, const Action& action) {
    for (uint32_t first = 0; first < paths; first += kPathsTogether)
        action(RowRange{first, std::min(kPathsTogether, paths - first)});
}

} // namespace

PathRecords::PathRecords(Device& device, const PathRecordsOptions& options, BufferRange counters,
                         BufferRange state)
    : options_(options)
    , pathRows_(paddedRows(options.trainingPaths))
    , counters_(counters)
    , state_(state)
    , paths_(device, "training paths", pathRows_ * kPathBytes)
    , vertices_(device, "training vertices", pathRows_ * kVertexBytes)
    , queries_(device, "training queries", pathRows_ * kInputBytes)
    , pathSums_(device, "training path sums", uint64_t{pathRows_} * 16)
    , firstRecords_(device, "first records", uint64_t{pathRows_} * 4)
    , inputs_(device, "record inputs", std::max(options.capacity, 1u) * kInputBytes)
    , targets_(device, "record targets", std::max(options.capacity, 1u) * uint64_t{16})
    , propagateTraining_(device, kernels::propagate_training)
    , countRecords_(device, kernels::count_records)
    , writeRecords_(device, kernels::write_records) {}

std::vector<Device::PlannedBuffer> PathRecords::planned(const PathRecordsOptions& options) {
    const uint64_t paths = paddedRows(options.trainingPaths), capacity = std::max(options.capacity, 1u);
    // Who traces paths binds those of a wave; its own plan says how many these are.
    const uint64_t together = std::min<uint64_t>(paths, kPathsTogether);
    return {{"training paths", paths * kPathBytes, together * kPathBytes},
            {"training vertices", paths * kVertexBytes, together * kVertexBytes},
            {"training queries", paths * kInputBytes},
            {"training path sums", paths * 16},
            {"first records", paths * 4},
            {"record inputs", capacity * kInputBytes},
            {"record targets", capacity * 16}};
}

uint32_t PathRecords::pathsTogether(const PathRecordsOptions& options) {
    return std::min(options.trainingPaths, kPathsTogether);
}

gpu::RecordsParams PathRecords::params(uint32_t paths) const {
    return {paths, options_.capacity, options_.factorise ? 1u : 0u, options_.meanDecay};
}

// What belongs to the training paths of a part; of the last as far as there are rows.
BufferRange PathRecords::ofPart(const Buffer& all, const RowRange& part, uint64_t pathBytes) const {
    const uint64_t rows = std::min(kPathsTogether, pathRows_ - part.first);
    return {all, part.first * pathBytes, rows * pathBytes};
}

void PathRecords::begin(FrameGraph& graph) {
    graph.fill(paths_, 0); // no vertices, not ended in the cache
}

void PathRecords::propagate(FrameGraph& graph, uint32_t paths, const Predict& predict) {
    if (paths > options_.trainingPaths)
        fail(ExitCode::Internal, "radiance cache: {} training paths, at most {} were planned", paths,
             options_.trainingPaths);
    graph.fill({*counters_.buffer, counters_.offset + gpu::kTrainingPathCounter * 4, 4}, paths);
    forEachPart(paths, [&](const RowRange& part) {
        const BufferRange ends = ofPart(queries_, part, kInputBytes);
        const RowCount rows{counters_, gpu::kTrainingPathCounter,
                            static_cast<uint32_t>(ends.bytes / kInputBytes), part.first};
        const BufferRange predictions = predict(graph, rows, ends);
        graph.pass(propagateTraining_)
            .readWrite(counters_)
            .read(ofPart(paths_, part, kPathBytes))
            .readWrite(ofPart(vertices_, part, kVertexBytes))
            .read(ends)
            .read(predictions)
            .read(state_)
            .write(ofPart(pathSums_, part, 16))
            .push(params(part.rows))
            .dispatch(part.rows);
    });
}

void PathRecords::write(FrameGraph& graph, uint32_t paths) {
    graph.pass(countRecords_)
        .readWrite(counters_)
        .read(pathSums_)
        .write(firstRecords_)
        .readWrite(state_)
        .push(params(paths))
        .dispatchGroups(1);
    forEachPart(paths, [&](const RowRange& part) {
        graph.pass(writeRecords_)
            .readWrite(counters_)
            .read(ofPart(pathSums_, part, 16))
            .read(ofPart(firstRecords_, part, 4))
            .read(ofPart(vertices_, part, kVertexBytes))
            .read(state_)
            .write(inputs_)
            .write(targets_)
            .push(params(part.rows))
            .dispatch(uint64_t(part.rows) * gpu::kMaxTrainingVertices);
    });
}

Records PathRecords::records() const {
    return {RowCount{counters_, gpu::kRecordCounter, options_.capacity}, inputs_, targets_};
}

} // namespace irradia
