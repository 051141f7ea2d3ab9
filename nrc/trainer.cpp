#include "nrc/trainer.h"

#include "engine/error.h"
#include "kernels/nrc.h"
#include "nrc/loss.h"
#include "nrc/model_file.h"
#include "nrc/optimizer.h"
#include "nrc/row_padding.h"
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

// A CPU learns from a batch in parts of so many rows: of 8 layers of 128 neurons their activations fit into a
// binding (128 MiB in lavapipe), and each pass takes many times what starting it does.
constexpr uint32_t kCpuPartRows = 16384;

// Whole chunks of the weights' gradient.
uint32_t rowsOfPart(const Device& device, uint32_t batchRows) {
    if (!device.isCpu() || batchRows <= kCpuPartRows) return paddedRows(batchRows);
    const uint32_t chunk = Network::chunkRows(batchRows);
    return std::max(kCpuPartRows / chunk, 1u) * chunk;
}

uint32_t wholeParts(uint32_t batchRows, uint32_t partRows) {
    return (std::max(batchRows, 1u) + partRows - 1) / partRows * partRows;
}

// What the passes of one batch hand on; reused from batch to batch, and what belongs to a part from part to
// part.
struct BatchBuffers {
    BatchBuffers(Device& device, const Encoding& encoding, const Network& network, uint32_t rows,
                 uint32_t partRows, uint32_t quadBytes)
        : inputs(device, "batch inputs", uint64_t(rows) * encoding.inputQuads() * 16)
        , targets(device, "batch targets", uint64_t(rows) * network.outputQuads() * 16)
        , usable(device, "usable records", uint64_t(rows) * 4)
        , encoded(device, "encoded inputs", uint64_t(rows) * encoding.width() / 4 * quadBytes)
        , activations(device, "activations", network.activationBytes(partRows))
        , results(device, "results", uint64_t(rows) * network.outputQuads() * 16)
        , resultGradient(device, "result gradient", uint64_t(rows) * network.outputQuads() * 16)
        , rowSums(device, "row losses", uint64_t(rows) * 16)
        , layerGradients(device, "layer gradients", network.layerGradientBytes(partRows))
        , encodedGradient(device, "gradient by encoded inputs",
                          encoding.featureCount() > 0 ? uint64_t(rows) * encoding.width() / 4 * quadBytes
                                                      : 16)
        , partials(device, "partial weight gradients", network.partialBytes(rows)) {}

    Buffer inputs, targets, usable, encoded, activations, results, resultGradient, rowSums, layerGradients,
        encodedGradient, partials;
};

} // namespace

struct Trainer::State {
    State(Device& d, const ModelConfig& c, uint32_t inputs, uint32_t outputs, const TrainerOptions& o)
        : device(d)
        , options(o)
        , encoding(d, c.encoding, inputs, c.network.precision, o.touched)
        , network(d, c.network, encoding.width(), outputs)
        , loss(makeLoss(d, c, outputs))
        , optimizer(d, c.optimizer)
        , weights(d, "weights", network.weightCount(), c.optimizer.learningRate, c.optimizer.l2,
                  GradientForm::Floats)
        , features(d, "features", encoding.featureCount(), c.optimizer.gridLearningRate, 0.0,
                   GradientForm::Sums)
        , partRows(rowsOfPart(d, o.batchRows))
        , batchRows(wholeParts(o.batchRows, partRows))
        , inferRows(paddedRows(o.inferRows))
        , quadBytes(c.network.precision == Precision::Half ? 8 : 16)
        , batch(d, encoding, network, batchRows, partRows, quadBytes)
        , state(makeBuffer(d, "training state", std::vector{Optimizer::initialState()}))
        , packed(d, "packed weights", network.packedBytes())
        , inferPacked(d, "packed weights of predictions", network.packedBytes())
        , inferEncoded(d, "encoded queries", uint64_t(inferRows) * encoding.width() / 4 * quadBytes)
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
    void gather(FrameGraph& graph, const Records& records, uint32_t index, uint32_t count);
    void learnPart(FrameGraph& graph, uint32_t first);
    void learn(FrameGraph& graph, uint32_t number, const TrainingEffort& effort);
    void packForTraining(FrameGraph& graph);
    void packForInference(FrameGraph& graph, Weights which);

    Device& device;
    TrainerOptions options;
    ModelConfig config;
    Encoding encoding;
    Network network;
    Loss loss;
    Optimizer optimizer;
    ParameterGroup weights, features;
    uint32_t partRows, batchRows, inferRows, quadBytes;
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

void Trainer::State::gather(FrameGraph& graph, const Records& records, uint32_t index, uint32_t count) {
    const gpu::BeginBatchParams begin{records.rows.index, records.rows.capacity, index, count,
                                      static_cast<uint32_t>(options.seed ^ (options.seed >> 32))};
    graph.pass(beginBatch).readWrite(state).read(records.rows.counters).push(begin).dispatchGroups(1);
    const gpu::GatherParams params{encoding.inputs(),
                                   network.outputs(),
                                   config.network.precision == Precision::Half ? kRecordLimitHalf
                                                                               : kRecordLimit,
                                   0,
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
        .dispatch(batchRows);
}

// Rows [first, first + partRows) of the batch, there and back.
void Trainer::State::learnPart(FrameGraph& graph, uint32_t first) {
    const RowCount rows{state, gpu::kBatchRowsWord, partRows, first};
    const auto part = [&](const Buffer& buffer, uint64_t rowBytes) {
        return BufferRange(buffer, first * rowBytes, partRows * rowBytes);
    };
    const uint64_t encodedBytes = uint64_t(encoding.width()) / 4 * quadBytes;
    const uint64_t resultBytes = uint64_t(network.outputQuads()) * 16;
    const BufferRange encoded = part(batch.encoded, encodedBytes), results = part(batch.results, resultBytes),
                      resultGradient = part(batch.resultGradient, resultBytes);
    network.forward(graph, rows, encoded, packed, batch.activations, results);
    loss.evaluate(graph, partRows, state, batch.results, batch.targets, batch.usable, batch.resultGradient,
                  batch.rowSums, first);
    const bool hasFeatures = features.count > 0;
    const BufferRange encodedGradient =
        hasFeatures ? part(batch.encodedGradient, encodedBytes) : BufferRange(batch.encodedGradient);
    network.backward(graph, rows, packed, batch.activations, results, resultGradient, batch.layerGradients,
                     hasFeatures ? &encodedGradient : nullptr);
    network.weightGradient(graph, rows, batchRows, encoded, batch.activations, batch.layerGradients,
                           batch.partials);
}

// `number`: the batch's in the first pass, or gpu::kLaterPass.
void Trainer::State::learn(FrameGraph& graph, uint32_t number, const TrainingEffort& effort) {
    const RowCount rows{state, gpu::kBatchRowsWord, batchRows};
    encoding.encode(graph, rows, batch.inputs, features.values, batch.encoded);
    for (uint32_t first = 0; first < batchRows; first += partRows) learnPart(graph, first);
    loss.endBatch(graph, state, batch.rowSums, number);
    network.sumGradients(graph, batchRows, batch.partials, weights.gradients, state, gpu::kGradientScaleWord);
    if (features.count > 0)
        encoding.accumulateGradient(graph, rows, batch.inputs, batch.encodedGradient, features.gradients);
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
    if (batches == 0 || uint64_t(records.rows.capacity) > uint64_t(batches) * state_->batchRows)
        fail(ExitCode::Internal, "trainer: {} records in {} steps of at most {}", records.rows.capacity,
             batches, state_->batchRows);
    const uint32_t steps = effort.steps == 0 ? batches : effort.steps;
    for (uint32_t step = 0; step < steps; ++step) {
        state_->packForTraining(graph);
        state_->gather(graph, records, step % batches, batches);
        state_->learn(graph, step < batches ? step : gpu::kLaterPass, effort);
        graph.cut();
    }
}

void Trainer::infer(FrameGraph& graph, const RowCount& rows, BufferRange inputs, BufferRange results,
                    Weights weights) {
    if (rows.capacity > state_->inferRows)
        fail(ExitCode::Internal, "trainer: {} rows to predict, at most {} were planned", rows.capacity,
             state_->inferRows);
    state_->packForInference(graph, weights);
    const ParameterGroup& features = state_->features;
    state_->encoding.encode(graph, rows, inputs,
                            weights == Weights::Ema ? features.averages : features.values,
                            state_->inferEncoded);
    state_->network.infer(graph, rows, state_->inferEncoded, state_->inferPacked, results);
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
