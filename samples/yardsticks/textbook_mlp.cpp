#include "engine/graph/frame_graph.h"
#include "kernels/textbook.h"
#include "samples/yardsticks/mlp_yardstick.h"
#include "samples/yardsticks/textbook/textbook.h"
#include <chrono>

namespace irradia {
namespace {

KernelOptions constants(const MlpShape& shape) {
    return {{{2, shape.inputs}, {3, shape.width}, {4, shape.hiddenLayers}, {5, shape.outputs}}};
}

KernelOptions keepingActivations(const MlpShape& shape) {
    KernelOptions options = constants(shape);
    options.constants.push_back({6, 1});
    return options;
}

uint64_t hiddenBytes(const MlpProblem& problem) {
    return uint64_t(problem.rows) * problem.shape.hiddenLayers * problem.shape.width * sizeof(float);
}

class TextbookMlp final : public MlpYardstick {
public:
    TextbookMlp(Device& device, const MlpProblem& problem);

    double infer() override;
    double train() override;

    std::vector<float> results() const override {
        return download<float>(device_, results_, size_t(rows_) * shape_.outputs);
    }
    std::vector<float> gradients() const override {
        return download<float>(device_, gradients_, shape_.multiplyAdds());
    }
    std::vector<float> weights() const override {
        return download<float>(device_, weights_, shape_.multiplyAdds());
    }

private:
    double execute();

    Device& device_;
    MlpShape shape_;
    uint32_t rows_;
    uint32_t step_ = 0;
    Kernel infer_, forward_, backward_, weightGradient_, adam_;
    Buffer inputs_, targets_, weights_, activations_, results_;
    Buffer resultGradients_, hiddenGradients_, gradients_, moments_;
    FrameGraph graph_;
};

TextbookMlp::TextbookMlp(Device& device, const MlpProblem& problem)
    : device_(device)
    , shape_(problem.shape)
    , rows_(problem.rows)
    , infer_(device, kernels::textbook_mlp, constants(shape_))
    , forward_(device, kernels::textbook_mlp, keepingActivations(shape_))
    , backward_(device, kernels::textbook_backward, constants(shape_))
    , weightGradient_(device, kernels::textbook_weight_gradient, constants(shape_))
    , adam_(device, kernels::textbook_adam, constants(shape_))
    , inputs_(makeBuffer(device, "textbook inputs", problem.inputs))
    , targets_(makeBuffer(device, "textbook targets", problem.targets))
    , weights_(makeBuffer(device, "textbook weights", problem.weights))
    , activations_(device, "textbook activations", hiddenBytes(problem))
    , results_(device, "textbook results", problem.targets.size() * sizeof(float))
    , resultGradients_(device, "textbook result gradients", problem.targets.size() * sizeof(float))
    , hiddenGradients_(device, "textbook hidden gradients", hiddenBytes(problem))
    , gradients_(device, "textbook gradients", problem.weights.size() * sizeof(float))
    , moments_(device, "textbook moments", 2 * problem.weights.size() * sizeof(float))
    , graph_(device) {}

double TextbookMlp::execute() {
    const auto start = std::chrono::steady_clock::now();
    graph_.execute();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double TextbookMlp::infer() {
    graph_.pass(infer_)
        .read(inputs_)
        .read(weights_)
        .write(activations_)
        .write(results_)
        .push(gpu::TextbookParams{rows_})
        .dispatch(rows_);
    return execute();
}

double TextbookMlp::train() {
    const AdamConstants adam;
    const auto weightCount = static_cast<uint32_t>(shape_.multiplyAdds());
    const gpu::TextbookParams params{rows_,      weightCount, ++step_,     adam.learningRate,
                                     adam.beta1, adam.beta2,  adam.epsilon};
    graph_.pass(forward_)
        .read(inputs_)
        .read(weights_)
        .write(activations_)
        .write(results_)
        .push(params)
        .dispatch(rows_);
    graph_.pass(backward_)
        .read(weights_)
        .read(activations_)
        .read(results_)
        .read(targets_)
        .write(resultGradients_)
        .write(hiddenGradients_)
        .push(params)
        .dispatch(rows_);
    graph_.pass(weightGradient_)
        .read(inputs_)
        .read(activations_)
        .read(resultGradients_)
        .read(hiddenGradients_)
        .write(gradients_)
        .push(params)
        .dispatch(weightCount);
    graph_.pass(adam_)
        .read(gradients_)
        .readWrite(moments_)
        .readWrite(weights_)
        .push(params)
        .dispatch(weightCount);
    return execute();
}

} // namespace

std::unique_ptr<MlpYardstick> makeTextbookMlp(Device& device, const MlpProblem& problem) {
    return std::make_unique<TextbookMlp>(device, problem);
}

} // namespace irradia
