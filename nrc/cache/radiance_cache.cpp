#include "nrc/cache/radiance_cache.h"

#include "engine/error.h"
#include "kernels/cache.h"
#include "nrc/learning/batch_rows.h"
#include "shared/network.h"
#include <algorithm>

namespace irradia {
namespace {

constexpr uint64_t kInputBytes = gpu::kCacheInputQuads * 16;
constexpr uint64_t kPathBytes = gpu::kTrainingPathBytes, kVertexBytes = gpu::kVertexBytes; // of products

// Training paths whose vertices become records together: their range fits any device's binding, and one
// dispatch takes all of their vertices.
constexpr uint32_t kPathsTogether = 1u << 16;

// Records of a step, and of a frame, at most: their number follows the picture, and is never exactly what was
// wanted.
uint32_t stepCapacity(const CacheOptions& options) {
    return paddedRows((options.records + options.records / 2) / std::max(options.steps, 1u));
}
uint32_t recordCapacity(const CacheOptions& options) {
    return stepCapacity(options) * std::max(options.steps, 1u);
}

// Rows of queries that are answered together at most: a wave's, or those of a part of the training paths.
uint32_t answeredRows(const CacheOptions& options) {
    return paddedRows(std::max(options.queries, std::min(options.trainingPaths, kPathsTogether)));
}

TrainerOptions trainerOptions(const CacheOptions& options) {
    TrainerOptions trainer;
    trainer.batchRows = stepCapacity(options);
    trainer.inferRows = answeredRows(options);
    trainer.seed = options.seed;
    trainer.touched = options.touched;
    return trainer;
}

BufferRange word(const Buffer& buffer, uint32_t index) {
    return {buffer, index * 4, 4};
}

} // namespace

struct RadianceCache::State {
    State(Device& d, const CacheOptions& o)
        : device(d)
        , options(o)
        , capacity(recordCapacity(o))
        , queryRows(paddedRows(o.queries))
        , pathRows(paddedRows(o.trainingPaths))
        , trainer(d, o.model, gpu::kCacheInputs, gpu::kCacheOutputs, trainerOptions(o))
        , queries(d, "cache queries", queryRows * kInputBytes)
        , queryWeights(d, "query weights", uint64_t(queryRows) * 16)
        , predictions(d, "predictions", uint64_t(answeredRows(o)) * 16)
        , counters(d, "cache counters", gpu::kCacheCounters * 4)
        , trainingPaths(d, "training paths", pathRows * kPathBytes)
        , trainingVertices(d, "training vertices", pathRows * kVertexBytes)
        , trainingQueries(d, "training queries", pathRows * kInputBytes)
        , pathSums(d, "training path sums", uint64_t(pathRows) * 16)
        , firstRecords(d, "first records", uint64_t(pathRows) * 4)
        , recordInputs(d, "record inputs", capacity * kInputBytes)
        , recordTargets(d, "record targets", uint64_t(capacity) * 16)
        , state(makeBuffer(d, "cache state", std::vector{gpu::CacheState{1.0f, 1.0f, 0, 0, 0, 0, 0, 0}}))
        , resolveQueries(d, kernels::resolve_queries)
        , propagateTraining(d, kernels::propagate_training)
        , countRecords(d, kernels::count_records)
        , writeRecords(d, kernels::write_records)
        , rescaleOutputs(d, kernels::rescale_outputs) {}

    void writeTargets(FrameGraph& graph, uint32_t paths);
    void propagate(FrameGraph& graph, const RowRange& part);
    void writeRecordsOf(FrameGraph& graph, const RowRange& part);
    gpu::RecordsParams recordsParams(uint32_t paths) const {
        return {paths, capacity, options.factorise ? 1u : 0u, options.meanDecay};
    }
    // What belongs to the training paths of a part; of the last as far as there are rows.
    BufferRange ofPart(const Buffer& all, const RowRange& part, uint64_t pathBytes) const {
        const uint64_t rows = std::min(kPathsTogether, pathRows - part.first);
        return {all, part.first * pathBytes, rows * pathBytes};
    }
    void followScale(FrameGraph& graph);

    Device& device;
    CacheOptions options;
    uint32_t capacity, queryRows, pathRows;
    Trainer trainer;
    Buffer queries, queryWeights, predictions, counters;
    Buffer trainingPaths, trainingVertices, trainingQueries;
    Buffer pathSums, firstRecords, recordInputs, recordTargets;
    Buffer state; // gpu::CacheState
    Kernel resolveQueries, propagateTraining, countRecords, writeRecords, rescaleOutputs;
};

RadianceCache::RadianceCache(Device& device, const CacheOptions& options)
    : state_(std::make_unique<State>(device, options)) {}

RadianceCache::~RadianceCache() = default;

std::vector<Device::PlannedBuffer> RadianceCache::planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                          const CacheOptions& options) {
    const uint64_t paths = paddedRows(options.trainingPaths), queries = paddedRows(options.queries);
    const uint64_t capacity = recordCapacity(options);
    auto list = Trainer::planned(isCpu, limits, options.model, gpu::kCacheInputs, gpu::kCacheOutputs,
                                 trainerOptions(options));
    // Who traces paths binds those of a wave; its own plan says how many these are.
    const uint64_t together = std::min<uint64_t>(paths, kPathsTogether);
    list.insert(list.end(), {{"cache queries", queries * kInputBytes},
                             {"query weights", queries * 16},
                             {"predictions", uint64_t(answeredRows(options)) * 16},
                             {"training paths", paths * kPathBytes, together * kPathBytes},
                             {"training vertices", paths * kVertexBytes, together * kVertexBytes},
                             {"training queries", paths * kInputBytes},
                             {"training path sums", paths * 16},
                             {"first records", paths * 4},
                             {"record inputs", capacity * kInputBytes},
                             {"record targets", capacity * 16}});
    return list;
}

const CacheOptions& RadianceCache::options() const {
    return state_->options;
}
Trainer& RadianceCache::trainer() {
    return state_->trainer;
}
BufferRange RadianceCache::queries() const {
    return state_->queries;
}
BufferRange RadianceCache::queryWeights() const {
    return state_->queryWeights;
}
BufferRange RadianceCache::counters() const {
    return state_->counters;
}
const Buffer& RadianceCache::trainingPaths() const {
    return state_->trainingPaths;
}
const Buffer& RadianceCache::trainingVertices() const {
    return state_->trainingVertices;
}
BufferRange RadianceCache::trainingQueries() const {
    return state_->trainingQueries;
}

void RadianceCache::begin(FrameGraph& graph) {
    graph.fill(state_->trainingPaths, 0); // no vertices, not ended in the cache
}

void RadianceCache::beginQueries(FrameGraph& graph) {
    graph.fill(word(state_->counters, gpu::kQueryCounter), 0);
}

void RadianceCache::answer(FrameGraph& graph, BufferRange radiance, Weights weights, bool reflectance) {
    State& s = *state_;
    const RowCount rows{s.counters, gpu::kQueryCounter, s.queryRows};
    s.trainer.infer(graph, rows, s.queries, s.predictions, weights);
    graph.pass(s.resolveQueries)
        .readWrite(s.counters)
        .read(s.queries)
        .read(s.queryWeights)
        .read(s.predictions)
        .read(s.state)
        .readWrite(radiance)
        .push(gpu::ResolveParams{s.options.factorise && reflectance ? 1u : 0u})
        .dispatch(s.options.queries);
}

// From training paths to records: where paths ended the cache predicts, light goes back along them.
void RadianceCache::State::writeTargets(FrameGraph& graph, uint32_t paths) {
    const auto forEachPart = [&](auto&& action) {
        for (uint32_t first = 0; first < paths; first += kPathsTogether)
            action(RowRange{first, std::min(kPathsTogether, paths - first)});
    };
    graph.fill(word(counters, gpu::kTrainingPathCounter), paths);
    forEachPart([&](const RowRange& part) { propagate(graph, part); });
    graph.pass(countRecords)
        .readWrite(counters)
        .read(pathSums)
        .write(firstRecords)
        .readWrite(state)
        .push(recordsParams(paths))
        .dispatchGroups(1);
    forEachPart([&](const RowRange& part) { writeRecordsOf(graph, part); });
}

void RadianceCache::State::propagate(FrameGraph& graph, const RowRange& part) {
    const BufferRange ends = ofPart(trainingQueries, part, kInputBytes);
    const RowCount rows{counters, gpu::kTrainingPathCounter, static_cast<uint32_t>(ends.bytes / kInputBytes),
                        part.first};
    trainer.infer(graph, rows, ends, predictions, options.selfTraining);
    graph.pass(propagateTraining)
        .readWrite(counters)
        .read(ofPart(trainingPaths, part, kPathBytes))
        .readWrite(ofPart(trainingVertices, part, kVertexBytes))
        .read(ends)
        .read(predictions)
        .read(state)
        .write(ofPart(pathSums, part, 16))
        .push(recordsParams(part.rows))
        .dispatch(part.rows);
}

void RadianceCache::State::writeRecordsOf(FrameGraph& graph, const RowRange& part) {
    graph.pass(writeRecords)
        .readWrite(counters)
        .read(ofPart(pathSums, part, 16))
        .read(ofPart(firstRecords, part, 4))
        .read(ofPart(trainingVertices, part, kVertexBytes))
        .read(state)
        .write(recordInputs)
        .write(recordTargets)
        .push(recordsParams(part.rows))
        .dispatch(uint64_t(part.rows) * gpu::kMaxTrainingVertices);
}

// Outputs that are no linear function of the last layer are left to learn what has changed.
void RadianceCache::State::followScale(FrameGraph& graph) {
    const OutputActivation output = options.model.network.outputActivation;
    if (output != OutputActivation::None && output != OutputActivation::ReLU) return;
    const OutputLayer layer = trainer.outputLayer();
    const gpu::RescaleParams params{static_cast<uint32_t>(layer.values.bytes / 16)};
    graph.pass(rescaleOutputs)
        .read(state)
        .readWrite(layer.values)
        .readWrite(layer.averages)
        .push(params)
        .dispatch(params.quads);
}

void RadianceCache::learn(FrameGraph& graph, uint32_t paths, const TrainingEffort& effort) {
    State& s = *state_;
    if (paths > s.options.trainingPaths)
        fail(ExitCode::Internal, "radiance cache: {} training paths, at most {} were planned", paths,
             s.options.trainingPaths);
    if (paths == 0) return;
    s.writeTargets(graph, paths);
    s.followScale(graph);
    s.trainer.train(graph,
                    {RowCount{s.counters, gpu::kRecordCounter, s.capacity}, s.recordInputs, s.recordTargets},
                    s.options.steps, effort);
}

CacheCounts RadianceCache::counts() const {
    const State& s = *state_;
    const auto counters = download<uint32_t>(s.device, s.counters, gpu::kCacheCounters);
    CacheCounts counts;
    counts.records = counters[gpu::kRecordCounter];
    counts.skippedRecords = counters[gpu::kSkippedRecords];
    counts.clampedPredictions = counters[gpu::kClampedPredictions];
    counts.training = s.trainer.counts();
    counts.state = download<gpu::CacheState>(s.device, s.state, 1).front();
    return counts;
}

} // namespace irradia
