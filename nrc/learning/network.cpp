#include "nrc/learning/network.h"

#include "engine/error.h"
#include "nrc/learning/batch_rows.h"
#include "nrc/learning/network_kernels.h"
#include "nrc/learning/random.h"
#include <algorithm>
#include <cmath>

namespace irradia {

struct Network::State {
    NetworkConfig config;
    NetworkShape shape;
    NetworkKernels kernels;
    Buffer none; // bound where a pass has nothing to write
};

namespace {

NetworkConfig resolved(const Device& device, NetworkConfig config) {
    if (config.form == NetworkForm::Auto)
        config.form = device.isCpu() ? NetworkForm::Subgroup : NetworkForm::Workgroup;
    return config;
}

gpu::RowsParams paramsOf(const RowCount& rows, glm::uvec2 kept = {}) {
    return {rows.index, rows.capacity, rows.first, 0, kept};
}

void initialiseMatrix(std::span<float> matrix, uint32_t fanIn, uint32_t fanOut, RandomStream& random) {
    const float limit = std::sqrt(6.0f / static_cast<float>(fanIn + fanOut));
    for (float& weight : matrix) weight = limit * (2.0f * random.uniform() - 1.0f);
}

} // namespace

Network::Network(Device& device, const NetworkConfig& config, uint32_t inputs, uint32_t outputs,
                 uint32_t rowsPerLane)
    : state_(std::make_unique<State>()) {
    state_->config = resolved(device, config);
    state_->shape = checkedShape(config, inputs, outputs);
    state_->kernels = makeNetworkKernels(device, state_->config, state_->shape, rowsPerLane);
    state_->none = Buffer(device, "no input gradient", 16);
}

Network::~Network() = default;
Network::Network(Network&&) noexcept = default;

const NetworkConfig& Network::config() const {
    return state_->config;
}
const NetworkShape& Network::shape() const {
    return state_->shape;
}
uint32_t Network::inputs() const {
    return state_->shape.inputs;
}
uint32_t Network::outputs() const {
    return state_->shape.outputs;
}
uint32_t Network::outputQuads() const {
    return state_->shape.outputQuads();
}
uint32_t Network::sharedBytes() const {
    return state_->kernels.sharedBytes;
}
uint64_t Network::multiplyAdds() const {
    const uint64_t width = state_->shape.width;
    return width * (inputs() + (state_->shape.hiddenLayers - 1) * width + outputs());
}
uint64_t Network::weightCount() const {
    return state_->shape.weights();
}
uint32_t Network::weightQuads() const {
    return static_cast<uint32_t>(weightCount() / 4);
}
void Network::initialise(std::span<float> weights, uint64_t seed) const {
    const NetworkShape& shape = state_->shape;
    if (weights.size() != weightCount())
        fail(ExitCode::Internal, "network: {} weights to initialise, not {}", weights.size(), weightCount());
    RandomStream random(seed);
    size_t at = 0;
    for (uint32_t layer = 0; layer <= shape.hiddenLayers; ++layer) {
        const uint32_t fanIn = layer == 0 ? shape.inputs : shape.width;
        const uint32_t rows = layer == shape.hiddenLayers ? gpu::kFeaturePadding : shape.width;
        const uint32_t fanOut = layer == shape.hiddenLayers ? shape.outputs : shape.width;
        initialiseMatrix(weights.subspan(at, size_t(rows) * fanIn), fanIn, fanOut, random);
        at += size_t(rows) * fanIn;
    }
}

void Network::pack(FrameGraph& graph, BufferRange weights, BufferRange packed) const {
    const uint32_t quads = static_cast<uint32_t>(state_->shape.packedQuads());
    graph.pass(state_->kernels.pack, "pack_weights")
        .read(weights)
        .write(packed)
        .push(gpu::PackParams{quads})
        .dispatch(quads);
}

void Network::infer(FrameGraph& graph, const RowCount& rows, BufferRange encoded, BufferRange packed,
                    BufferRange results) const {
    graph.pass(state_->kernels.infer, "infer")
        .read(rows.counters)
        .read(encoded)
        .read(packed)
        .write(results)
        .push(paramsOf(rows))
        .dispatchGroups(state_->kernels.inferGroups(rows.capacity));
}

void Network::forward(FrameGraph& graph, const RowCount& rows, BufferRange encoded, BufferRange packed,
                      BufferRange activations, BufferRange results) const {
    graph.pass(state_->kernels.forward, "forward")
        .read(rows.counters)
        .read(encoded)
        .read(packed)
        .write(results)
        .write(activations)
        .push(paramsOf(rows, activations.address()))
        .dispatchGroups(state_->kernels.forwardGroups(rows.capacity));
}

void Network::backward(FrameGraph& graph, const RowCount& rows, BufferRange packed, BufferRange activations,
                       BufferRange results, BufferRange resultGradient, BufferRange layerGradients,
                       const BufferRange* inputGradient) const {
    const Kernel& kernel = inputGradient ? state_->kernels.backwardToInputs : state_->kernels.backward;
    graph.pass(kernel, "backward")
        .read(rows.counters)
        .read(packed)
        .read(activations)
        .read(results)
        .read(resultGradient)
        .write(layerGradients)
        .write(inputGradient ? *inputGradient : BufferRange(state_->none))
        .push(paramsOf(rows, layerGradients.address()))
        .dispatchGroups(state_->kernels.forwardGroups(rows.capacity));
}

void Network::weightGradient(FrameGraph& graph, const RowCount& rows, uint32_t batchCapacity,
                             BufferRange encoded, BufferRange activations, BufferRange layerGradients,
                             BufferRange partials) const {
    const NetworkKernels& kernels = state_->kernels;
    const uint32_t ofChunk = chunkRows(batchCapacity);
    const uint32_t end = rows.first + rows.capacity;
    if (rows.first % ofChunk != 0 || (end % ofChunk != 0 && end != batchCapacity))
        fail(ExitCode::Internal, "network: rows {} to {} are not whole chunks of {}", rows.first, end,
             ofChunk);
    const uint32_t chunks = chunkCount(rows.capacity, ofChunk);
    graph.pass(kernels.weightGradient, "weight_gradient")
        .read(rows.counters)
        .read(encoded)
        .read(activations)
        .read(layerGradients)
        .write(partials)
        .push(gpu::WeightGradientParams{rows.index, rows.first, rows.first / ofChunk, chunks, ofChunk,
                                        kernels.weightBlocks, weightQuads()})
        .dispatchGroups(kernels.weightGradientGroups(chunks));
}

void Network::sumGradients(FrameGraph& graph, uint32_t batchCapacity, BufferRange partials,
                           BufferRange gradients, BufferRange scale, uint32_t scaleWord) const {
    graph.pass(state_->kernels.sumGradients, "sum_gradients")
        .read(partials)
        .read(scale)
        .write(gradients)
        .push(gpu::SumGradientsParams{chunkCount(batchCapacity, chunkRows(batchCapacity)), weightQuads(),
                                      scaleWord})
        .dispatch(weightQuads());
}

} // namespace irradia
