// One thread's share of a batch, by oneDNN's primitives: an inner product a layer with ReLU fused into it,
// weights in the layout it prefers.
#pragma once

#include "samples/yardsticks/mlp_problem.h"
#include <oneapi/dnnl/dnnl.hpp>
#include <span>
#include <unordered_map>

namespace irradia {

// A batch's arrays, in plain rows; `weights` and `results` may change between calls.
struct OnednnBatch {
    std::span<float> inputs;
    std::span<float> results;
    std::span<const float> targets;
    std::span<float> weights;
};

// Runs on one thread at a time, whichever; made with OpenMP set to one thread.
class OnednnPart {
public:
    OnednnPart(const MlpShape& shape, const OnednnBatch& batch, uint32_t firstRow, uint32_t rows);

    void packForInference() { run(packInference_); }
    void infer();
    // Forward, the loss over the whole batch, backward: to this part's gradients by the weights.
    void differentiate();
    std::span<const float> gradients() const { return gradients_; }

private:
    using Forward = dnnl::inner_product_forward;
    struct Step {
        dnnl::primitive primitive;
        std::unordered_map<int, dnnl::memory> arguments;
    };
    using Steps = std::vector<Step>;

    dnnl::memory memory(const dnnl::memory::desc& layout, float* values = nullptr) const;
    dnnl::memory plainMatrix(std::span<float> all, uint32_t layer) const;
    template <typename Description>
    void add(Steps& steps, const Description& operation, std::unordered_map<int, dnnl::memory> arguments);
    Forward::primitive_desc forwardOf(uint32_t layer, uint32_t rows, dnnl::prop_kind kind) const;
    dnnl::memory packedWeights(const dnnl::memory::desc& layout, uint32_t layer, Steps& packing);
    void makeValues();
    void addInference(uint32_t layer);
    void addForward(uint32_t layer);
    void addBackward(uint32_t layer);
    void addReLUBackward(uint32_t layer);
    void run(const Steps& steps);
    void differentiateLoss();

    MlpShape shape_;
    uint32_t rows_;
    uint32_t chunkRows_; // evaluated together
    float lossScale_;    // of the gradient: 2 / values of the whole batch
    std::span<float> inputs_, results_, weights_;
    std::span<const float> targets_;
    dnnl::engine engine_{dnnl::engine::kind::cpu, 0};
    dnnl::stream stream_{engine_};

    std::vector<size_t> first_; // weight of each layer
    std::vector<float> gradients_;
    std::vector<dnnl::memory> chunks_; // what layer i reads in inference, and what the last one writes
    std::vector<dnnl::memory> values_; // the same of all rows
    std::vector<dnnl::memory> valueGradients_; // the loss' by those
    std::vector<Forward::primitive_desc> forward_;
    Steps packInference_, inference_;
    Steps packTraining_, training_, backward_;
};

} // namespace irradia
