#include "nrc/learning/trainer.h"

#include "kernels/learning.h"
#include "nrc/learning/trainer_state.h"
#include <algorithm>

namespace irradia {
namespace {

// Of a result's gradient where layers keep theirs in half precision: leaves them a factor of 16 to grow by,
// since one that overflows spoils the gradient of all weights it meets.
constexpr float kGradientLimitHalf = 4096.0f;

Loss makeLoss(Device& device, const ModelConfig& config, uint32_t outputs) {
    if (config.network.precision == Precision::Float) return {device, config.loss, outputs, 1.0f};
    return {device, config.loss, outputs, static_cast<float>(config.optimizer.lossScale), kGradientLimitHalf};
}

} // namespace

Trainer::State::State(Device& d, const ModelConfig& c, uint32_t inputs, uint32_t outputs,
                      const TrainerOptions& o)
    : device(d)
    , options(o)
    , sizes(d.isCpu(), d.limits(), c, inputs, outputs, o)
    , encoding(d, c.encoding, inputs, c.network.precision, o.touched)
    , network(d, c.network, encoding.width(), outputs)
    , loss(makeLoss(d, c, outputs))
    , optimizer(d, c.optimizer)
    , weights(d, "weights", network.weightCount(), c.optimizer.learningRate, c.optimizer.l2,
              GradientForm::Floats)
    , features(d, "features", encoding.featureCount(), c.optimizer.gridLearningRate, 0.0, GradientForm::Sums)
    , batch(d, sizes)
    , state(makeBuffer(d, "training state", std::vector{Optimizer::initialState()}))
    , packed(d, "packed weights", sizes.shape.packedBytes())
    , inferPacked(d, "packed weights of predictions", sizes.shape.packedBytes())
    , inferEncoded(d, "encoded queries", sizes.encodedBytes(sizes.inferRows))
    , beginBatch(d, kernels::begin_batch)
    , gatherRecords(d, d.storesByAddress() ? kernels::gather_records_by_address : kernels::gather_records) {
    config = c;
    config.network = network.config();
}

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
    if (inferPackedHolds.holds(graph, which)) return;
    network.pack(graph, which == Weights::Ema ? weights.averages : weights.values, inferPacked);
    inferPackedHolds.declare(graph, which);
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

TrainingCounts Trainer::counts() const {
    const auto state = download<gpu::TrainingState>(state_->device, state_->state, 1).front();
    return {state.steps, state.droppedRecords, state.clippedSteps, state.damagedParameters,
            state.loss,  state.meanPrediction, state.meanTarget};
}

} // namespace irradia
