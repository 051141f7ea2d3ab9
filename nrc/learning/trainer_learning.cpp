// A step of training: gather a batch, there and back in parts, update.
#include "engine/error.h"
#include "nrc/learning/trainer_state.h"
#include "shared/network.h"

namespace irradia {
namespace {

// Beyond these, values would leave the range of the encoded inputs' format, or squares that of single
// precision.
constexpr float kRecordLimit = 1e8f;
constexpr float kRecordLimitHalf = 6e4f;

static_assert(offsetof(gpu::TrainingState, batchRows) == 4 * gpu::kBatchRowsWord);
static_assert(offsetof(gpu::TrainingState, gradientScale) == 4 * gpu::kGradientScaleWord);

} // namespace

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
    inferPackedHolds.declare(graph, {});
}

void Trainer::train(FrameGraph& graph, const Records& records, uint32_t batches,
                    const TrainingEffort& effort) {
    if (batches == 0 || uint64_t(records.rows.capacity) > uint64_t(batches) * state_->sizes.batch.rows)
        fail(ExitCode::Internal, "trainer: {} records in {} steps of at most {}", records.rows.capacity,
             batches, state_->sizes.batch.rows);
    const uint32_t steps = effort.steps == 0 ? batches : effort.steps;
    const uint64_t seed = state_->options.seed;
    for (uint32_t step = 0; step < steps; ++step) {
        state_->network.pack(graph, state_->weights.values, state_->packed);
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

} // namespace irradia
