#include "tests/support/network_harness.h"

#include "shared/network.h"
#include "tests/reference/half.h"
#include "tests/reference/random.h"
#include "tests/support/kernel_harness.h"
#include <fmt/format.h>

namespace irradia::test {

namespace {

NetworkConfig configOf(const NetworkCase& shape) {
    NetworkConfig config;
    config.width = shape.width;
    config.hiddenLayers = shape.hidden;
    config.outputActivation = shape.output;
    config.precision = shape.precision;
    config.form = shape.form;
    return config;
}

reference::Activation twinOf(OutputActivation activation) {
    switch (activation) {
    case OutputActivation::ReLU:
        return reference::Activation::ReLU;
    case OutputActivation::Exponential:
        return reference::Activation::Exponential;
    case OutputActivation::Softplus:
        return reference::Activation::Softplus;
    case OutputActivation::None:
        break;
    }
    return reference::Activation::None;
}

std::vector<double> storedUniform(reference::Random& random, size_t count, double bound,
                                  Precision precision) {
    std::vector<double> values;
    for (size_t i = 0; i < count; ++i)
        values.push_back(stored(bound * (2.0 * random.uniform() - 1.0), precision));
    return values;
}

} // namespace

std::string NetworkCase::name() const {
    const char* activations[] = {"", " relu", " exp", " softplus"};
    return fmt::format("{} -> {}x{} -> {}{}, {}, {}", inputs, width, hidden, outputs,
                       activations[static_cast<int>(output)], precision == Precision::Half ? "half" : "float",
                       form == NetworkForm::Workgroup ? "workgroup" : "subgroup");
}

NetworkHarness::NetworkHarness(const NetworkCase& shape, uint32_t rowsPerLane, uint32_t capacity,
                               double filling)
    : shape_(shape)
    , capacity_(capacity)
    , filling_(filling)
    , network_(validatedDevice(), configOf(shape), shape.inputs, shape.outputs, rowsPerLane)
    , weights_(validatedDevice(), "weights", network_.weightCount() * sizeof(float))
    , packed_(validatedDevice(), "packed weights", network_.shape().packedBytes())
    , counters_(validatedDevice(), "counters", 2 * sizeof(uint32_t)) {}

reference::Mlp NetworkHarness::twin() const {
    reference::Mlp mlp{shape_.inputs, shape_.width, shape_.hidden, shape_.outputs, twinOf(shape_.output)};
    mlp.storedOutputs = gpu::kFeaturePadding;
    if (shape_.precision == Precision::Half) mlp.store = reference::roundToHalf;
    mlp.handsOnStored = shape_.form == NetworkForm::Workgroup; // the subgroup form hands on in registers
    return mlp;
}

std::vector<double> NetworkHarness::randomWeights(uint64_t seed) const {
    reference::Random random(seed);
    std::vector<double> weights;
    for (const reference::Matrix& matrix : twin().matrices()) {
        const double bound = std::sqrt(6.0 / static_cast<double>(matrix.columns));
        const auto values = storedUniform(random, matrix.rows * matrix.columns, bound, shape_.precision);
        weights.insert(weights.end(), values.begin(), values.end());
    }
    return weights;
}

void NetworkHarness::setWeights(const std::vector<double>& weights) {
    const std::vector<float> singles(weights.begin(), weights.end());
    upload<float>(validatedDevice(), weights_, singles);
    FrameGraph graph(validatedDevice());
    network_.pack(graph, weights_, packed_);
    graph.execute();
}

NetworkBatch NetworkHarness::randomBatch(uint32_t count, uint64_t seed) const {
    reference::Random random(seed);
    return {count, storedUniform(random, size_t{count} * shape_.inputs, 1.0, shape_.precision),
            storedUniform(random, size_t{count} * shape_.outputs, 1.0, Precision::Float)};
}

RowCount NetworkHarness::rows(uint32_t count) {
    upload<uint32_t>(validatedDevice(), counters_, std::vector<uint32_t>{capacity_, count});
    return {counters_, 1, capacity_};
}

Buffer NetworkHarness::used(const char* name, uint64_t bytes) const {
    return makeBuffer(validatedDevice(), name,
                      std::vector<float>((bytes + 3) / 4, static_cast<float>(filling_)));
}

NetworkOutputs NetworkHarness::run(const NetworkBatch& batch, float scale) {
    const Buffer encoded = rowBuffer(encodedRows(), capacity_, batch.encoded, filling_);
    // Its padding is zero, as the losses write it.
    const Buffer resultGradient = rowBuffer(resultRows(), capacity_, batch.resultGradient, 0.0);
    const Buffer results = used("results", resultRows().bytes(capacity_));
    const Buffer activations = used("activations", network_.shape().activationBytes(capacity_));
    const Buffer layerGradients = used("layer gradients", network_.shape().layerGradientBytes(capacity_));
    const Buffer inputGradient = used("input gradient", encodedRows().bytes(capacity_));
    const Buffer partials = used("partials", network_.shape().partialBytes(capacity_));
    const Buffer gradients = used("gradients", network_.weightCount() * sizeof(float));
    const Buffer scales = makeBuffer<float>(validatedDevice(), "scales", {1e9f, scale});
    const BufferRange inputGradientRange = inputGradient;

    FrameGraph graph(validatedDevice());
    const RowCount count = rows(batch.count);
    network_.forward(graph, count, encoded, packed_, activations, results);
    network_.backward(graph, count, packed_, activations, results, resultGradient, layerGradients,
                      &inputGradientRange);
    network_.weightGradient(graph, count, capacity_, encoded, activations, layerGradients, partials);
    network_.sumGradients(graph, capacity_, partials, gradients, scales, 1);
    graph.execute();

    const auto gradient = download<float>(validatedDevice(), gradients, network_.weightCount());
    return {infer(batch), downloadRows(results, resultRows(), batch.count),
            downloadRows(activations, activationRows(), batch.count),
            downloadRows(inputGradient, encodedRows(), batch.count),
            std::vector<double>(gradient.begin(), gradient.end())};
}

std::vector<double> NetworkHarness::infer(const NetworkBatch& batch) {
    const Buffer encoded = rowBuffer(encodedRows(), capacity_, batch.encoded, filling_);
    const Buffer results = used("results", resultRows().bytes(capacity_));
    FrameGraph graph(validatedDevice());
    network_.infer(graph, rows(batch.count), encoded, packed_, results);
    graph.execute();
    return downloadRows(results, resultRows(), batch.count);
}

} // namespace irradia::test
