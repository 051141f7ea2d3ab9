// A fully fused multilayer perceptron (Müller 2021, section 4): all layers in one dispatch, hidden layers of
// one width with ReLU, no bias vectors. Layer l computes a_l = act(W_l a_(l-1)); W_0 is width x inputs, the
// last one outputs x width.
#pragma once

#include "engine/graph/frame_graph.h"
#include "nrc/learning/config.h"
#include "nrc/learning/network_shape.h"
#include "nrc/learning/row_count.h"
#include <memory>
#include <span>

namespace irradia {

class Network {
public:
    // inputs: a multiple of gpu::kFeaturePadding (Encoding::width); outputs: 1 to 16. Throws Error(BadData)
    // with the numbers where the shape does not fit the device's shared memory. `rowsPerLane`: of the
    // subgroup form, 1 to 4, 0 = the fastest known; changes no result.
    Network(Device& device, const NetworkConfig& config, uint32_t inputs, uint32_t outputs,
            uint32_t rowsPerLane = 0);
    ~Network();
    Network(Network&&) noexcept;

    const NetworkConfig& config() const; // form resolved: never Auto
    const NetworkShape& shape() const;   // with the sizes of the buffers below
    uint32_t inputs() const;
    uint32_t outputs() const;
    uint32_t outputQuads() const; // of a row of results: ceil(outputs / 4); the last quad's rest is undefined
    uint32_t sharedBytes() const; // of a workgroup, the most of all kernels
    uint64_t multiplyAdds() const; // a row: inputs * width + (hiddenLayers - 1) * width^2 + width * outputs

    // Weights, single precision, matrix after matrix, each with rows of outputs; the last matrix has
    // kFeaturePadding rows, of which `outputs` are used.
    uint64_t weightCount() const;
    // Uniform in +-sqrt(6 / (fan in + fan out)) (Glorot and Bengio 2010).
    void initialise(std::span<float> weights, uint64_t seed) const;

    // What kernels read: weights in `precision`, in the order in which lanes want them; forwards and
    // transposed. packed: shape().packedBytes().
    void pack(FrameGraph& graph, BufferRange weights, BufferRange packed) const;

    // encoded: rows of inputs() / 4 quads of `precision`; results: rows of outputQuads() single-precision
    // quads.
    void infer(FrameGraph& graph, const RowCount& rows, BufferRange encoded, BufferRange packed,
               BufferRange results) const;

    // The same, keeping what the backward pass needs: rows of hiddenLayers * width / 4 quads of `precision`,
    // shape().activationBytes().
    void forward(FrameGraph& graph, const RowCount& rows, BufferRange encoded, BufferRange packed,
                 BufferRange activations, BufferRange results) const;

    // From the gradient of the loss by the results (after the output's activation, so that `results` are read
    // too) to that by each layer's sums before its activation, shape().layerGradientBytes(); with
    // `inputGradient`, also by the encoded inputs (rows of inputs() / 4 quads). resultGradient beyond
    // outputs() must be zero in a row's last quad. Half precision: the subgroup form hands on to the next
    // layer what it has in registers, the workgroup form what it has rounded. An exponential output that is
    // cut at exp(30) still has its own value as derivative, so that training can bring it back.
    void backward(FrameGraph& graph, const RowCount& rows, BufferRange packed, BufferRange activations,
                  BufferRange results, BufferRange resultGradient, BufferRange layerGradients,
                  const BufferRange* inputGradient) const;

    // Sums of layer gradient x activation over rows, in the chunks of a batch of `batchCapacity` rows
    // (nrc/learning/batch_rows.h), shape().partialBytes(): `rows` may be a part of the batch that is whole
    // chunks of it. Then, of all parts: gradients (weightCount() floats) = the chunks' sums in order, times
    // the float at word `scaleWord` of `scale`. So the result depends neither on threads nor on the parts.
    void weightGradient(FrameGraph& graph, const RowCount& rows, uint32_t batchCapacity, BufferRange encoded,
                        BufferRange activations, BufferRange layerGradients, BufferRange partials) const;
    void sumGradients(FrameGraph& graph, uint32_t batchCapacity, BufferRange partials, BufferRange gradients,
                      BufferRange scale, uint32_t scaleWord) const;

private:
    uint32_t weightQuads() const;
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace irradia
