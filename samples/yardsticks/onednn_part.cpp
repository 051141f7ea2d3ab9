#include "samples/yardsticks/onednn_part.h"
#include <algorithm>

namespace irradia {
namespace {

using Dims = dnnl::memory::dims;
using Tag = dnnl::memory::format_tag;

// As many rows' activations stay in a core's own cache from layer to layer.
constexpr uint32_t kInferenceRows = 1024;

dnnl::memory::desc matrix(uint64_t rows, uint64_t columns, Tag tag = Tag::ab) {
    return {Dims{int64_t(rows), int64_t(columns)}, dnnl::memory::data_type::f32, tag};
}

// A primitive that brings no memory of its own may run on any thread.
dnnl::primitive_attr withoutScratchpad() {
    dnnl::primitive_attr attributes;
    attributes.set_scratchpad_mode(dnnl::scratchpad_mode::user);
    return attributes;
}

dnnl::primitive_attr withReLU() {
    dnnl::post_ops operations;
    operations.append_eltwise(1.0f, dnnl::algorithm::eltwise_relu, 0.0f, 0.0f);
    dnnl::primitive_attr attributes = withoutScratchpad();
    attributes.set_post_ops(operations);
    return attributes;
}

} // namespace

OnednnPart::OnednnPart(const MlpShape& shape, const OnednnBatch& batch, uint32_t firstRow, uint32_t rows)
    : shape_(shape)
    , rows_(rows)
    , chunkRows_(rows % kInferenceRows == 0 ? kInferenceRows : rows)
    , lossScale_(2.0f / float(batch.targets.size()))
    , inputs_(batch.inputs.subspan(size_t(firstRow) * shape.inputs, size_t(rows) * shape.inputs))
    , results_(batch.results.subspan(size_t(firstRow) * shape.outputs, size_t(rows) * shape.outputs))
    , weights_(batch.weights)
    , targets_(batch.targets.subspan(size_t(firstRow) * shape.outputs, size_t(rows) * shape.outputs))
    , gradients_(batch.weights.size()) {
    makeValues();
    for (uint32_t layer = 0; layer < shape_.layerCount(); ++layer) {
        addInference(layer);
        addForward(layer);
    }
    for (uint32_t layer = shape_.layerCount(); layer-- > 0;) addBackward(layer);
}

dnnl::memory OnednnPart::memory(const dnnl::memory::desc& layout, float* values) const {
    return values ? dnnl::memory(layout, engine_, values) : dnnl::memory(layout, engine_);
}

// The layer's matrix in plain rows, inside `all`.
dnnl::memory OnednnPart::plainMatrix(std::span<float> all, uint32_t layer) const {
    const LayerShape size = shape_.layer(layer);
    return memory(matrix(size.outputs, size.inputs), all.data() + first_[layer]);
}

void OnednnPart::makeValues() {
    size_t first = 0;
    for (uint32_t layer = 0; layer < shape_.layerCount(); ++layer) {
        const LayerShape size = shape_.layer(layer);
        first_.push_back(first);
        first += size_t(size.inputs) * size.outputs;
        float* inputs = layer == 0 ? inputs_.data() : nullptr;
        chunks_.push_back(memory(matrix(chunkRows_, size.inputs), inputs));
        values_.push_back(memory(matrix(rows_, size.inputs), inputs));
        valueGradients_.push_back(layer == 0 ? dnnl::memory() : memory(matrix(rows_, size.inputs)));
    }
    chunks_.push_back(memory(matrix(chunkRows_, shape_.outputs), results_.data()));
    values_.push_back(memory(matrix(rows_, shape_.outputs), results_.data()));
    valueGradients_.push_back(memory(matrix(rows_, shape_.outputs)));
}

template <typename Description>
void OnednnPart::add(Steps& steps, const Description& operation,
                     std::unordered_map<int, dnnl::memory> arguments) {
    if (operation.scratchpad_desc().get_size() > 0)
        arguments.emplace(DNNL_ARG_SCRATCHPAD, memory(operation.scratchpad_desc()));
    steps.push_back({dnnl::primitive(operation.get()), std::move(arguments)});
}

OnednnPart::Forward::primitive_desc OnednnPart::forwardOf(uint32_t layer, uint32_t rows,
                                                          dnnl::prop_kind kind) const {
    const LayerShape size = shape_.layer(layer);
    const Forward::desc operation(kind, matrix(rows, size.inputs),
                                  matrix(size.outputs, size.inputs, Tag::any), matrix(rows, size.outputs));
    return {operation, layer < shape_.hiddenLayers ? withReLU() : withoutScratchpad(), engine_};
}

// The layer's weights in `layout`, which `packing` fills from the plain ones.
dnnl::memory OnednnPart::packedWeights(const dnnl::memory::desc& layout, uint32_t layer, Steps& packing) {
    const dnnl::memory plain = plainMatrix(weights_, layer);
    if (layout == plain.get_desc()) return plain;
    const dnnl::memory packed = memory(layout);
    add(packing, dnnl::reorder::primitive_desc(plain, packed, withoutScratchpad()),
        {{DNNL_ARG_FROM, plain}, {DNNL_ARG_TO, packed}});
    return packed;
}

void OnednnPart::addInference(uint32_t layer) {
    const auto operation = forwardOf(layer, chunkRows_, dnnl::prop_kind::forward_inference);
    add(inference_, operation,
        {{DNNL_ARG_SRC, chunks_[layer]},
         {DNNL_ARG_WEIGHTS, packedWeights(operation.weights_desc(), layer, packInference_)},
         {DNNL_ARG_DST, chunks_[layer + 1]}});
}

void OnednnPart::addForward(uint32_t layer) {
    forward_.push_back(forwardOf(layer, rows_, dnnl::prop_kind::forward_training));
    add(training_, forward_.back(),
        {{DNNL_ARG_SRC, values_[layer]},
         {DNNL_ARG_WEIGHTS, packedWeights(forward_.back().weights_desc(), layer, packTraining_)},
         {DNNL_ARG_DST, values_[layer + 1]}});
}

void OnednnPart::addBackward(uint32_t layer) {
    const LayerShape size = shape_.layer(layer);
    const dnnl::memory::desc input = matrix(rows_, size.inputs), output = matrix(rows_, size.outputs);
    const dnnl::memory::desc any = matrix(size.outputs, size.inputs, Tag::any);

    using ByWeights = dnnl::inner_product_backward_weights;
    const ByWeights::primitive_desc byWeights(ByWeights::desc(input, any, output), withoutScratchpad(),
                                              engine_, forward_[layer]);
    const dnnl::memory plain = plainMatrix(gradients_, layer);
    const bool isPlain = byWeights.diff_weights_desc() == plain.get_desc();
    const dnnl::memory gradient = isPlain ? plain : memory(byWeights.diff_weights_desc());
    add(backward_, byWeights,
        {{DNNL_ARG_SRC, values_[layer]},
         {DNNL_ARG_DIFF_DST, valueGradients_[layer + 1]},
         {DNNL_ARG_DIFF_WEIGHTS, gradient}});
    if (!isPlain)
        add(backward_, dnnl::reorder::primitive_desc(gradient, plain, withoutScratchpad()),
            {{DNNL_ARG_FROM, gradient}, {DNNL_ARG_TO, plain}});
    if (layer == 0) return;

    using ByData = dnnl::inner_product_backward_data;
    const ByData::primitive_desc byData(ByData::desc(input, any, output), withoutScratchpad(), engine_,
                                        forward_[layer]);
    add(backward_, byData,
        {{DNNL_ARG_DIFF_DST, valueGradients_[layer + 1]},
         {DNNL_ARG_WEIGHTS, packedWeights(byData.weights_desc(), layer, packTraining_)},
         {DNNL_ARG_DIFF_SRC, valueGradients_[layer]}});
    addReLUBackward(layer);
}

// In place, on the gradient of what `layer` reads.
void OnednnPart::addReLUBackward(uint32_t layer) {
    const dnnl::memory::desc values = matrix(rows_, shape_.width);
    const auto kind = dnnl::algorithm::eltwise_relu_use_dst_for_bwd;
    using ReLU = dnnl::eltwise_forward;
    using ReLUBackward = dnnl::eltwise_backward;
    const ReLU::primitive_desc hint(ReLU::desc(dnnl::prop_kind::forward_training, kind, values, 0.0f, 0.0f),
                                    engine_);
    add(backward_,
        ReLUBackward::primitive_desc(ReLUBackward::desc(kind, values, values, 0.0f, 0.0f),
                                     withoutScratchpad(), engine_, hint),
        {{DNNL_ARG_DST, values_[layer]},
         {DNNL_ARG_DIFF_DST, valueGradients_[layer]},
         {DNNL_ARG_DIFF_SRC, valueGradients_[layer]}});
}

void OnednnPart::run(const Steps& steps) {
    for (const Step& step : steps) step.primitive.execute(stream_, step.arguments);
    stream_.wait();
}

void OnednnPart::infer() {
    for (uint32_t row = 0; row < rows_; row += chunkRows_) {
        chunks_.front().set_data_handle(inputs_.data() + size_t(row) * shape_.inputs);
        chunks_.back().set_data_handle(results_.data() + size_t(row) * shape_.outputs);
        run(inference_);
    }
}

void OnednnPart::differentiate() {
    run(packTraining_);
    run(training_);
    differentiateLoss();
    run(backward_);
}

void OnednnPart::differentiateLoss() {
    auto* gradient = static_cast<float*>(valueGradients_.back().get_data_handle());
    for (size_t i = 0; i < targets_.size(); ++i) gradient[i] = lossScale_ * (results_[i] - targets_[i]);
}

} // namespace irradia
