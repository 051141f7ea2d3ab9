#include "nrc/cache/neural_cache.h"

#include "nrc/cache/cache_queries.h"
#include "nrc/cache/model_facts.h"
#include "nrc/cache/radiance_scale.h"
#include "nrc/cache/training_records.h"
#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace irradia {
namespace {

// Records of a step, and of a frame, at most: their number follows the picture, and is never exactly what was
// wanted.
uint32_t stepCapacity(const NeuralCacheOptions& options, const CacheRoom& room) {
    return paddedRows((room.records + room.records / 2) / std::max(options.steps, 1u));
}

PathRecordsOptions recordsOptions(const NeuralCacheOptions& options, const CacheRoom& room) {
    return {room.trainingPaths, stepCapacity(options, room) * std::max(options.steps, 1u), options.factorise,
            options.meanDecay};
}

// Rows of queries that are answered together at most: a wave's, or those of a part of the training paths.
uint32_t answeredRows(const NeuralCacheOptions& options, const CacheRoom& room) {
    return paddedRows(std::max(room.queries, PathRecords::pathsTogether(recordsOptions(options, room))));
}

TrainerOptions trainerOptions(const NeuralCacheOptions& options, const CacheRoom& room) {
    TrainerOptions trainer;
    trainer.batchRows = stepCapacity(options, room);
    trainer.inferRows = answeredRows(options, room);
    trainer.seed = options.seed;
    trainer.touched = options.touched;
    return trainer;
}

// Of the outputs.
const char* meaningOf(const NeuralCacheOptions& options) {
    return options.factorise ? "radiance over reflectance" : "radiance";
}

} // namespace

struct NeuralCache::State {
    State(Device& d, const NeuralCacheOptions& o, const CacheRoom& room)
        : device(d)
        , options(o)
        , trainer(d, o.model, gpu::kCacheInputs, gpu::kCacheOutputs, trainerOptions(o, room))
        , scale(d)
        , queries(d, room.queries)
        , records(d, recordsOptions(o, room), queries.counters(), scale.state())
        , predictions(d, "predictions", uint64_t(answeredRows(o, room)) * 16) {}

    Device& device;
    NeuralCacheOptions options;
    Trainer trainer;
    RadianceScale scale;
    CacheQueries queries;
    PathRecords records;
    Buffer predictions;
};

NeuralCache::NeuralCache(Device& device, const NeuralCacheOptions& options, const CacheRoom& room)
    : state_(std::make_unique<State>(device, options, room)) {}

NeuralCache::~NeuralCache() = default;

std::vector<Device::PlannedBuffer> NeuralCache::planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                        const NeuralCacheOptions& options,
                                                        const CacheRoom& room) {
    auto list = Trainer::planned(isCpu, limits, options.model, gpu::kCacheInputs, gpu::kCacheOutputs,
                                 trainerOptions(options, room));
    std::ranges::move(CacheQueries::planned(room.queries), std::back_inserter(list));
    std::ranges::move(PathRecords::planned(recordsOptions(options, room)), std::back_inserter(list));
    list.push_back({"predictions", uint64_t(answeredRows(options, room)) * 16});
    return list;
}

Trainer& NeuralCache::trainer() {
    return state_->trainer;
}

CacheBuffers NeuralCache::buffers() const {
    const State& s = *state_;
    return {s.queries.inputs(), s.queries.weights(),  s.queries.counters(),
            s.records.paths(),  s.records.vertices(), s.records.queries()};
}

void NeuralCache::begin(FrameGraph& graph) {
    state_->records.begin(graph);
}

void NeuralCache::beginQueries(FrameGraph& graph) {
    state_->queries.begin(graph);
}

void NeuralCache::answer(FrameGraph& graph, BufferRange radiance) {
    State& s = *state_;
    s.trainer.infer(graph, s.queries.rows(), s.queries.inputs(), s.predictions, s.options.shown);
    s.queries.resolve(graph, s.predictions, s.scale.state(), s.options.factorise && s.options.showReflectance,
                      radiance);
}

void NeuralCache::learn(FrameGraph& graph, uint32_t paths, const TrainingEffort& effort) {
    State& s = *state_;
    if (paths == 0) return;
    const auto predict = [&s](FrameGraph& g, const RowCount& rows, BufferRange inputs) -> BufferRange {
        s.trainer.infer(g, rows, inputs, s.predictions, s.options.selfTraining);
        return s.predictions;
    };
    s.records.propagate(graph, paths, predict);
    s.records.write(graph, paths);
    s.scale.follow(graph, s.trainer);
    s.trainer.train(graph, s.records.records(), s.options.steps, effort);
}

CacheCounts NeuralCache::counts() const {
    const State& s = *state_;
    const auto counters = download<uint32_t>(s.device, s.queries.counters(), gpu::kCacheCounters);
    CacheCounts counts;
    counts.records = counters[gpu::kRecordCounter];
    counts.skippedRecords = counters[gpu::kSkippedRecords];
    counts.clampedPredictions = counters[gpu::kClampedPredictions];
    counts.training = s.trainer.counts();
    counts.state = s.scale.read();
    return counts;
}

void NeuralCache::save(const std::filesystem::path& file) const {
    const State& s = *state_;
    ModelFile model(kCacheModel);
    model.addText(kCacheMeaningBlock, meaningOf(s.options));
    model.add<gpu::CacheState>(kCacheStateBlock, std::vector{s.scale.read()});
    s.trainer.save(file, std::move(model));
}

void NeuralCache::load(const std::filesystem::path& file) {
    State& s = *state_;
    const ModelFile model = ModelFile::read(file, kCacheModel);
    if (const std::string meaning = model.text(kCacheMeaningBlock); meaning != meaningOf(s.options))
        model.refuse(fmt::format("it predicts {}, and {} is wanted", meaning, meaningOf(s.options)));
    const gpu::CacheState state = model.values<gpu::CacheState>(kCacheStateBlock, 1).front();
    s.trainer.load(model);
    s.scale.set(state);
}

std::map<std::string, std::string> NeuralCache::attributes() const {
    return {{"model", toJson(state_->trainer.config())}};
}

CacheKind neuralCache(const NeuralCacheOptions& options) {
    return {[options](bool isCpu, const VkPhysicalDeviceLimits& limits, const CacheRoom& room) {
                return NeuralCache::planned(isCpu, limits, options, room);
            },
            [options](Device& device, const CacheRoom& room) {
                return std::make_unique<NeuralCache>(device, options, room);
            }};
}

} // namespace irradia
