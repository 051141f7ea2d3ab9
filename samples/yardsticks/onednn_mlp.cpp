// oneDNN's way: an inner product a layer, with ReLU fused into it, weights in the layout it prefers.
#include "samples/yardsticks/mlp_yardstick.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <omp.h>
#include <oneapi/dnnl/dnnl.hpp>
#include <unordered_map>

namespace irradia {
namespace {

using Arguments = std::unordered_map<int, dnnl::memory>;
using Dims = dnnl::memory::dims;
using Tag = dnnl::memory::format_tag;

// Activations of this many rows stay in the caches from layer to layer: faster than whole batches by a third
// at 64x5, and long enough for the threads' synchronisation not to count.
constexpr uint32_t kInferenceRows = 8192;

dnnl::memory::desc matrix(uint64_t rows, uint64_t columns, Tag tag = Tag::ab) {
    return {Dims{int64_t(rows), int64_t(columns)}, dnnl::memory::data_type::f32, tag};
}

std::vector<float> floatsOf(const dnnl::memory& memory, size_t count) {
    const auto* values = static_cast<const float*>(memory.get_data_handle());
    return {values, values + count};
}

dnnl::primitive_attr fusedReLU() {
    dnnl::post_ops operations;
    operations.append_eltwise(1.0f, dnnl::algorithm::eltwise_relu, 0.0f, 0.0f);
    dnnl::primitive_attr attributes;
    attributes.set_post_ops(operations);
    return attributes;
}

struct Step {
    dnnl::primitive primitive;
    Arguments arguments;
};
using Steps = std::vector<Step>;

class OnednnMlp final : public MlpYardstick {
public:
    OnednnMlp(const MlpProblem& problem, uint32_t threads);

    double infer() override;
    double train() override;

    std::vector<float> results() const override { return floatsOf(results_, targets_.size()); }
    std::vector<float> gradients() const override { return gradients_; }
    std::vector<float> weights() const override { return weights_; }

private:
    using Forward = dnnl::inner_product_forward;

    dnnl::memory memory(const dnnl::memory::desc& layout, float* values = nullptr) const {
        return values ? dnnl::memory(layout, engine_, values) : dnnl::memory(layout, engine_);
    }
    // The layer's matrix in plain rows, inside `all`.
    dnnl::memory plainMatrix(std::vector<float>& all, uint32_t layer) {
        const LayerShape size = shape_.layer(layer);
        return memory(matrix(size.outputs, size.inputs), all.data() + first_[layer]);
    }
    Forward::primitive_desc forwardOf(uint32_t layer, uint32_t rows, dnnl::prop_kind kind) const;
    dnnl::memory packedWeights(const dnnl::memory::desc& layout, uint32_t layer, Steps& packing);
    void addInference(uint32_t layer);
    void addForward(uint32_t layer);
    void addBackward(uint32_t layer, const Forward::primitive_desc& forward);
    void addReLUBackward(uint32_t layer);
    void run(const Steps& steps);
    void differentiateLoss();
    void applyAdam();

    MlpShape shape_;
    uint32_t rows_;
    uint32_t inferenceRows_;
    uint32_t threads_;
    dnnl::engine engine_{dnnl::engine::kind::cpu, 0};
    dnnl::stream stream_{engine_};

    std::vector<size_t> first_; // weight of each layer
    std::vector<float> inputs_, targets_, weights_, gradients_, firstMoments_, secondMoments_;
    dnnl::memory results_, resultGradient_;
    std::vector<dnnl::memory> chunks_; // what layer i reads, in inference; the last is what they end in
    std::vector<dnnl::memory> values_; // what layer i reads, of the whole batch
    std::vector<dnnl::memory> valueGradients_; // the loss' by those
    std::vector<Forward::primitive_desc> forward_;
    Steps packInference_, packForward_, packBackward_;
    Steps inference_, training_, backward_, unpackGradients_;
    uint32_t step_ = 0;
    bool isPacked_ = false; // weights for inference
};

OnednnMlp::OnednnMlp(const MlpProblem& problem, uint32_t threads)
    : shape_(problem.shape)
    , rows_(problem.rows)
    , inferenceRows_(rows_ % kInferenceRows == 0 ? kInferenceRows : rows_)
    , threads_(threads)
    , inputs_(problem.inputs)
    , targets_(problem.targets)
    , weights_(problem.weights)
    , gradients_(weights_.size())
    , firstMoments_(weights_.size())
    , secondMoments_(weights_.size())
    , results_(memory(matrix(rows_, shape_.outputs)))
    , resultGradient_(memory(matrix(rows_, shape_.outputs))) {
    omp_set_num_threads(int(threads_));
    size_t first = 0;
    for (uint32_t layer = 0; layer < shape_.layerCount(); ++layer) {
        const LayerShape size = shape_.layer(layer);
        first_.push_back(first);
        first += size_t(size.inputs) * size.outputs;
        const bool isInput = layer == 0;
        chunks_.push_back(memory(matrix(inferenceRows_, size.inputs), isInput ? inputs_.data() : nullptr));
        values_.push_back(memory(matrix(rows_, size.inputs), isInput ? inputs_.data() : nullptr));
        valueGradients_.push_back(isInput ? dnnl::memory() : memory(matrix(rows_, size.inputs)));
    }
    chunks_.push_back(
        memory(matrix(inferenceRows_, shape_.outputs), static_cast<float*>(results_.get_data_handle())));
    values_.push_back(results_);
    valueGradients_.push_back(resultGradient_);
    for (uint32_t layer = 0; layer < shape_.layerCount(); ++layer) {
        addInference(layer);
        addForward(layer);
    }
    for (uint32_t layer = shape_.layerCount(); layer-- > 0;) addBackward(layer, forward_[layer]);
}

OnednnMlp::Forward::primitive_desc OnednnMlp::forwardOf(uint32_t layer, uint32_t rows,
                                                        dnnl::prop_kind kind) const {
    const LayerShape size = shape_.layer(layer);
    const Forward::desc operation(kind, matrix(rows, size.inputs),
                                  matrix(size.outputs, size.inputs, Tag::any), matrix(rows, size.outputs));
    const bool isHidden = layer < shape_.hiddenLayers;
    return {operation, isHidden ? fusedReLU() : dnnl::primitive_attr(), engine_};
}

// The layer's weights in `layout`, which `packing` fills from the plain ones.
dnnl::memory OnednnMlp::packedWeights(const dnnl::memory::desc& layout, uint32_t layer, Steps& packing) {
    const dnnl::memory plain = plainMatrix(weights_, layer);
    if (layout == plain.get_desc()) return plain;
    const dnnl::memory packed = memory(layout);
    packing.push_back({dnnl::reorder(plain, packed), {{DNNL_ARG_FROM, plain}, {DNNL_ARG_TO, packed}}});
    return packed;
}

void OnednnMlp::addInference(uint32_t layer) {
    const auto operation = forwardOf(layer, inferenceRows_, dnnl::prop_kind::forward_inference);
    inference_.push_back({Forward(operation),
                          {{DNNL_ARG_SRC, chunks_[layer]},
                           {DNNL_ARG_WEIGHTS, packedWeights(operation.weights_desc(), layer, packInference_)},
                           {DNNL_ARG_DST, chunks_[layer + 1]}}});
}

void OnednnMlp::addForward(uint32_t layer) {
    forward_.push_back(forwardOf(layer, rows_, dnnl::prop_kind::forward_training));
    training_.push_back(
        {Forward(forward_.back()),
         {{DNNL_ARG_SRC, values_[layer]},
          {DNNL_ARG_WEIGHTS, packedWeights(forward_.back().weights_desc(), layer, packForward_)},
          {DNNL_ARG_DST, values_[layer + 1]}}});
}

void OnednnMlp::addBackward(uint32_t layer, const Forward::primitive_desc& forward) {
    const LayerShape size = shape_.layer(layer);
    const dnnl::memory::desc input = matrix(rows_, size.inputs), output = matrix(rows_, size.outputs);
    const dnnl::memory::desc any = matrix(size.outputs, size.inputs, Tag::any);

    using ByWeights = dnnl::inner_product_backward_weights;
    const ByWeights::primitive_desc byWeights(ByWeights::desc(input, any, output), engine_, forward);
    const dnnl::memory plain = plainMatrix(gradients_, layer);
    const bool isPlain = byWeights.diff_weights_desc() == plain.get_desc();
    const dnnl::memory gradient = isPlain ? plain : memory(byWeights.diff_weights_desc());
    backward_.push_back({ByWeights(byWeights),
                         {{DNNL_ARG_SRC, values_[layer]},
                          {DNNL_ARG_DIFF_DST, valueGradients_[layer + 1]},
                          {DNNL_ARG_DIFF_WEIGHTS, gradient}}});
    if (!isPlain)
        unpackGradients_.push_back(
            {dnnl::reorder(gradient, plain), {{DNNL_ARG_FROM, gradient}, {DNNL_ARG_TO, plain}}});
    if (layer == 0) return;

    using ByData = dnnl::inner_product_backward_data;
    const ByData::primitive_desc byData(ByData::desc(input, any, output), engine_, forward);
    backward_.push_back({ByData(byData),
                         {{DNNL_ARG_DIFF_DST, valueGradients_[layer + 1]},
                          {DNNL_ARG_WEIGHTS, packedWeights(byData.weights_desc(), layer, packBackward_)},
                          {DNNL_ARG_DIFF_SRC, valueGradients_[layer]}}});
    addReLUBackward(layer);
}

// In place, on the gradient of what `layer` reads.
void OnednnMlp::addReLUBackward(uint32_t layer) {
    const dnnl::memory::desc values = matrix(rows_, shape_.width);
    const auto kind = dnnl::algorithm::eltwise_relu_use_dst_for_bwd;
    using ReLU = dnnl::eltwise_forward;
    using ReLUBackward = dnnl::eltwise_backward;
    const ReLU::primitive_desc hint(ReLU::desc(dnnl::prop_kind::forward_training, kind, values, 0.0f, 0.0f),
                                    engine_);
    const ReLUBackward::primitive_desc operation(ReLUBackward::desc(kind, values, values, 0.0f, 0.0f),
                                                 engine_, hint);
    backward_.push_back({ReLUBackward(operation),
                         {{DNNL_ARG_DST, values_[layer]},
                          {DNNL_ARG_DIFF_DST, valueGradients_[layer]},
                          {DNNL_ARG_DIFF_SRC, valueGradients_[layer]}}});
}

void OnednnMlp::run(const Steps& steps) {
    for (const Step& step : steps) step.primitive.execute(stream_, step.arguments);
}

double OnednnMlp::infer() {
    if (!isPacked_) run(packInference_);
    isPacked_ = true;
    stream_.wait();
    const auto start = std::chrono::steady_clock::now();
    auto* results = static_cast<float*>(results_.get_data_handle());
    for (uint32_t row = 0; row < rows_; row += inferenceRows_) {
        chunks_.front().set_data_handle(inputs_.data() + size_t(row) * shape_.inputs);
        chunks_.back().set_data_handle(results + size_t(row) * shape_.outputs);
        run(inference_);
    }
    stream_.wait();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double OnednnMlp::train() {
    const auto start = std::chrono::steady_clock::now();
    run(packForward_);
    run(packBackward_);
    run(training_);
    stream_.wait();
    differentiateLoss();
    run(backward_);
    run(unpackGradients_);
    stream_.wait();
    applyAdam();
    isPacked_ = false;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void OnednnMlp::differentiateLoss() {
    const auto* results = static_cast<const float*>(results_.get_data_handle());
    auto* gradient = static_cast<float*>(resultGradient_.get_data_handle());
    const float scale = 2.0f / float(targets_.size());
    for (size_t i = 0; i < targets_.size(); ++i) gradient[i] = scale * (results[i] - targets_[i]);
}

void OnednnMlp::applyAdam() {
    const AdamConstants adam;
    ++step_;
    const float firstScale = 1.0f / (1.0f - std::pow(adam.beta1, float(step_)));
    const float secondScale = 1.0f / (1.0f - std::pow(adam.beta2, float(step_)));
    for (size_t i = 0; i < weights_.size(); ++i) {
        const float g = gradients_[i];
        firstMoments_[i] = adam.beta1 * firstMoments_[i] + (1.0f - adam.beta1) * g;
        secondMoments_[i] = adam.beta2 * secondMoments_[i] + (1.0f - adam.beta2) * g * g;
        const float direction = firstMoments_[i] * firstScale;
        weights_[i] -=
            adam.learningRate * direction / (std::sqrt(secondMoments_[i] * secondScale) + adam.epsilon);
    }
}

} // namespace

std::unique_ptr<MlpYardstick> makeOnednnMlp(const MlpProblem& problem, uint32_t threads) {
    return std::make_unique<OnednnMlp>(problem, threads);
}

} // namespace irradia
