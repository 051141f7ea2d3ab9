#include "nrc/learning/trainer.h"

#include "engine/error.h"
#include "kernels/learning.h"
#include "nrc/learning/loss.h"
#include "nrc/learning/model_file.h"
#include "nrc/learning/optimizer.h"
#include "nrc/learning/trainer_sizes.h"
#include "shared/network.h"
#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace irradia {
namespace {

// Beyond these, values would leave the range of the encoded inputs' format, or squares that of single
// precision.
constexpr float kRecordLimit = 1e8f;
constexpr float kRecordLimitHalf = 6e4f;
// Of a result's gradient where layers keep theirs in half precision: leaves them a factor of 16 to grow by,
// since one that overflows spoils the gradient of all weights it meets.
constexpr float kGradientLimitHalf = 4096.0f;

static_assert(offsetof(gpu::TrainingState, batchRows) == 4 * gpu::kBatchRowsWord);
static_assert(offsetof(gpu::TrainingState, gradientScale) == 4 * gpu::kGradientScaleWord);

Loss makeLoss(Device& device, const ModelConfig& config, uint32_t outputs) {
    if (config.network.precision == Precision::Float) return {device, config.loss, outputs, 1.0f};
    return {device, config.loss, outputs, static_cast<float>(config.optimizer.lossScale), kGradientLimitHalf};
}

// What the passes of one batch hand on; reused from batch to batch, and from part to part of it.
struct BatchBuffers {
    BatchBuffers(Device& device, const TrainerSizes& sizes)
        : inputs(device, "batch inputs", sizes.inputBytes(sizes.batch.partRows))
        , targets(device, "batch targets", sizes.resultBytes(sizes.batch.partRows))
        , usable(device, "usable records", uint64_t(sizes.batch.partRows) * 4)
        , encoded(device, "encoded inputs", sizes.encodedBytes(sizes.batch.partRows))
        , activations(device, "activations", sizes.shape.activationBytes(sizes.batch.partRows))
        , results(device, "results", sizes.resultBytes(sizes.batch.partRows))
        , resultGradient(device, "result gradient", sizes.resultBytes(sizes.batch.partRows))
        , layerGradients(device, "layer gradients", sizes.shape.layerGradientBytes(sizes.batch.partRows))
        , encodedGradient(device, "gradient by encoded inputs", sizes.encodedGradientBytes())
        , rowSums(device, "row losses", uint64_t(sizes.batch.rows) * 16)
        , partials(device, "partial weight gradients", sizes.shape.partialBytes(sizes.batch.rows)) {}

    Buffer inputs, targets, usable, encoded, activations, results, resultGradient, layerGradients,
        encodedGradient;      // of a part
    Buffer rowSums, partials; // of the batch
};

} // namespace

struct Trainer::State {
    State(Device& d, const ModelConfig& c, uint32_t inputs, uint32_t outputs, const TrainerOptions& o)
        : device(d)
        , options(o)
        , sizes(d.isCpu(), d.limits(), c, inputs, outputs, o)
        , encoding(d, c.encoding, inputs, c.network.precision, o.touched)
        , network(d, c.network, encoding.width(), outputs)
        , loss(makeLoss(d, c, outputs))
        , optimizer(d, c.optimizer)
        , weights(d, "weights", network.weightCount(), c.optimizer.learningRate, c.optimizer.l2,
                  GradientForm::Floats)
        , features(d, "features", encoding.featureCount(), c.optimizer.gridLearningRate, 0.0,
                   GradientForm::Sums)
        , batch(d, sizes)
        , state(makeBuffer(d, "training state", std::vector{Optimizer::initialState()}))
        , packed(d, "packed weights", sizes.packedBytes())
        , inferPacked(d, "packed weights of predictions", sizes.packedBytes())
        , inferEncoded(d, "encoded queries", sizes.encodedBytes(sizes.inferRows))
        , beginBatch(d, kernels::begin_batch)
        , gatherRecords(d,
                        d.storesByAddress() ? kernels::gather_records_by_address : kernels::gather_records) {
        config = c;
        config.network = network.config();
    }

    std::vector<const ParameterGroup*> groups() const {
        if (features.count == 0) return {&weights};
        return {&weights, &features};
    }

    void initialise();
    void gather(FrameGraph& graph, const Records& records, const RowRange& part);
    void learnPart(FrameGraph& graph, const Records& records, const RowRange& part);
    void learn(FrameGraph& graph, const Records& records, uint32_t number, const TrainingEffort& effort);
    void packForTraining(FrameGraph& graph);
    void packForInference(FrameGraph& graph, Weights which);

    Device& device;
    TrainerOptions options;
    TrainerSizes sizes;
    ModelConfig config;
    Encoding encoding;
    Network network;
    Loss loss;
    Optimizer optimizer;
    ParameterGroup weights, features;
    BatchBuffers batch;
    Buffer state; // gpu::TrainingState
    Buffer packed, inferPacked, inferEncoded;
    Kernel beginBatch, gatherRecords;
    bool packedIsCurrent = false;
    std::optional<Weights> inferPackedHolds;
};

// Averages of no step yet: the first one replaces them.
void Trainer::State::initialise() {
    std::vector<float> values(network.weightCount());
    network.initialise(values, options.seed);
    upload<float>(device, weights.values, values);
    upload<float>(device, weights.averages, values);
    if (features.count == 0) return;
    values.resize(features.count);
    encoding.initialise(values, options.seed + 1);
    upload<float>(device, features.values, values);
    upload<float>(device, features.averages, values);
}

void Trainer::State::packForInference(FrameGraph& graph, Weights which) {
    if (inferPackedHolds == which) return;
    network.pack(graph, which == Weights::Ema ? weights.averages : weights.values, inferPacked);
    inferPackedHolds = which;
}

void Trainer::State::packForTraining(FrameGraph& graph) {
    if (!packedIsCurrent) network.pack(graph, weights.values, packed);
    packedIsCurrent = true;
}

// The part's share of the batch that begin_batch has chosen.
void Trainer::State::gather(FrameGraph& graph, const Records& records, const RowRange& part) {
    const gpu::GatherParams params{encoding.inputs(),
                                   network.outputs(),
                                   config.network.precision == Precision::Half ? kRecordLimitHalf
                                                                               : kRecordLimit,
                                   part.first,
                                   BufferRange(batch.inputs).address(),
                                   BufferRange(batch.targets).address()};
    graph.pass(gatherRecords, "gather_records")
        .readWrite(state)
        .read(records.inputs)
        .read(records.targets)
        .write(batch.inputs)
        .write(batch.targets)
        .write(batch.usable)
        .push(params)
        .dispatch(part.rows);
}

// There and back.
void Trainer::State::learnPart(FrameGraph& graph, const Records& records, const RowRange& part) {
    const RowCount rows{state, gpu::kBatchRowsWord, part.rows, part.first};
    gather(graph, records, part);
    encoding.encode(graph, rows, batch.inputs, features.values, batch.encoded);
    network.forward(graph, rows, batch.encoded, packed, batch.activations, batch.results);
    loss.evaluate(graph, part.rows, state, batch.results, batch.targets, batch.usable, batch.resultGradient,
                  {batch.rowSums, uint64_t(part.first) * 16, uint64_t(part.rows) * 16}, part.first);
    const BufferRange encodedGradient = batch.encodedGradient;
    network.backward(graph, rows, packed, batch.activations, batch.results, batch.resultGradient,
                     batch.layerGradients, features.count > 0 ? &encodedGradient : nullptr);
    network.weightGradient(graph, rows, sizes.batch.rows, batch.encoded, batch.activations,
                           batch.layerGradients, batch.partials);
    if (features.count > 0)
        encoding.accumulateGradient(graph, rows, batch.inputs, batch.encodedGradient, features.gradients);
}

// `number`: the batch's in the first pass, or gpu::kLaterPass.
void Trainer::State::learn(FrameGraph& graph, const Records& records, uint32_t number,
                           const TrainingEffort& effort) {
    for (uint32_t first = 0; first < sizes.batch.rows; first += sizes.batch.partRows)
        learnPart(graph, records, sizes.batch.partFrom(first));
    loss.endBatch(graph, state, batch.rowSums, number);
    network.sumGradients(graph, sizes.batch.rows, batch.partials, weights.gradients, state,
                         gpu::kGradientScaleWord);
    optimizer.step(graph, state, groups(), effort.emaDecay, effort.learningRate);
    packedIsCurrent = false;
    inferPackedHolds.reset();
}

Trainer::Trainer(Device& device, const ModelConfig& config, uint32_t inputs, uint32_t outputs,
                 const TrainerOptions& options)
    : state_(std::make_unique<State>(device, config, inputs, outputs, options)) {
    state_->initialise();
}

Trainer::~Trainer() = default;

std::vector<Device::PlannedBuffer> Trainer::planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                    const ModelConfig& config, uint32_t inputs,
                                                    uint32_t outputs, const TrainerOptions& options) {
    return TrainerSizes(isCpu, limits, config, inputs, outputs, options).planned();
}

const ModelConfig& Trainer::config() const {
    return state_->config;
}
const Network& Trainer::network() const {
    return state_->network;
}
const Encoding& Trainer::encoding() const {
    return state_->encoding;
}
uint64_t Trainer::parameterCount() const {
    return state_->weights.count + state_->features.count;
}

void Trainer::train(FrameGraph& graph, const Records& records, uint32_t batches,
                    const TrainingEffort& effort) {
    if (batches == 0 || uint64_t(records.rows.capacity) > uint64_t(batches) * state_->sizes.batch.rows)
        fail(ExitCode::Internal, "trainer: {} records in {} steps of at most {}", records.rows.capacity,
             batches, state_->sizes.batch.rows);
    const uint32_t steps = effort.steps == 0 ? batches : effort.steps;
    const uint64_t seed = state_->options.seed;
    for (uint32_t step = 0; step < steps; ++step) {
        state_->packForTraining(graph);
        const gpu::BeginBatchParams begin{records.rows.index, records.rows.capacity, step % batches, batches,
                                          static_cast<uint32_t>(seed ^ (seed >> 32))};
        graph.pass(state_->beginBatch)
            .readWrite(state_->state)
            .read(records.rows.counters)
            .push(begin)
            .dispatchGroups(1);
        state_->learn(graph, records, step < batches ? step : gpu::kLaterPass, effort);
        graph.cut();
    }
}

void Trainer::infer(FrameGraph& graph, const RowCount& rows, BufferRange inputs, BufferRange results,
                    Weights weights) {
    state_->packForInference(graph, weights);
    const BufferRange features =
        weights == Weights::Ema ? state_->features.averages : state_->features.values;
    const TrainerSizes& sizes = state_->sizes;
    for (uint32_t first = 0; first < rows.capacity; first += sizes.inferRows) {
        const uint32_t count = std::min(sizes.inferRows, rows.capacity - first);
        const RowCount part{rows.counters, rows.index, count, rows.first + first};
        const auto ofPart = [&](const BufferRange& all, uint64_t bytes) {
            return BufferRange(*all.buffer, all.offset + bytes / count * first, bytes);
        };
        state_->encoding.encode(graph, part, ofPart(inputs, sizes.inputBytes(count)), features,
                                state_->inferEncoded);
        state_->network.infer(graph, part, state_->inferEncoded, state_->inferPacked,
                              ofPart(results, sizes.resultBytes(count)));
    }
}

OutputLayer Trainer::outputLayer() const {
    const ParameterGroup& weights = state_->weights;
    const uint64_t bytes = uint64_t(gpu::kFeaturePadding) * state_->config.network.width * 4;
    const uint64_t first = weights.count * 4 - bytes;
    return {{weights.values, first, bytes}, {weights.averages, first, bytes}};
}

std::string Trainer::shapeName() const {
    const ModelConfig& model = state_->config;
    std::string name =
        fmt::format("{} with {} inputs, {} outputs, output activation {}, encoding {}",
                    describe(model.network), state_->encoding.inputs(), state_->network.outputs(),
                    describe(model.network.outputActivation), describe(model.encoding));
    if (const auto corners = state_->encoding.storedCorners())
        name += fmt::format(" at corners {:08x}", *corners);
    return name;
}

TrainingCounts Trainer::counts() const {
    const auto state = download<gpu::TrainingState>(state_->device, state_->state, 1).front();
    return {state.steps, state.droppedRecords, state.clippedSteps, state.damagedParameters,
            state.loss,  state.meanPrediction, state.meanTarget};
}

std::vector<float> Trainer::parameters(Weights which) const {
    std::vector<float> all;
    for (const ParameterGroup* group : state_->groups()) {
        const Buffer& from = which == Weights::Ema ? group->averages : group->values;
        const auto values = download<float>(state_->device, from, group->count);
        all.insert(all.end(), values.begin(), values.end());
    }
    return all;
}

void Trainer::save(const std::filesystem::path& file) const {
    std::vector<float> content;
    for (const ParameterGroup* group : state_->groups())
        for (const Buffer* buffer : group->learned()) {
            const auto values = download<float>(state_->device, *buffer, group->count);
            content.insert(content.end(), values.begin(), values.end());
        }
    const auto state = download<gpu::TrainingState>(state_->device, state_->state, 1).front();
    writeModel(file, {shapeName(), toJson(state_->config), state, std::move(content)});
}

void Trainer::load(const std::filesystem::path& file) {
    uint64_t count = 0;
    for (const ParameterGroup* group : state_->groups()) count += group->learned().size() * group->count;
    const ModelFile model = readModel(file, shapeName(), count);
    std::span<const float> rest = model.content;
    for (const ParameterGroup* group : state_->groups())
        for (const Buffer* buffer : group->learned()) {
            upload<float>(state_->device, *buffer, rest.first(group->count));
            rest = rest.subspan(group->count);
        }
    upload<gpu::TrainingState>(state_->device, state_->state, std::span(&model.state, 1));
    state_->packedIsCurrent = false;
    state_->inferPackedHolds.reset();
}

void Trainer::setParameters(std::span<const float> values) {
    if (values.size() != parameterCount())
        fail(ExitCode::Internal, "trainer: {} parameters to set, not {}", values.size(), parameterCount());
    for (const ParameterGroup* group : state_->groups()) {
        upload<float>(state_->device, group->values, values.first(group->count));
        values = values.subspan(group->count);
    }
    state_->packedIsCurrent = false;
    state_->inferPackedHolds.reset();
}

} // namespace irradia
