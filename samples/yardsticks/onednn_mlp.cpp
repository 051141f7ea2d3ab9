// The network by oneDNN, each thread with its share of the rows. (oneDNN's own threads, OpenMP's, meet after
// every layer: half as fast on an idle machine, a tenth as soon as anything else runs.)
#include "samples/yardsticks/mlp_yardstick.h"
#include "samples/yardsticks/onednn_part.h"
#include "samples/yardsticks/parallel_time.h"
#include <algorithm>
#include <barrier>
#include <cmath>
#include <omp.h>

namespace irradia {
namespace {

class OnednnMlp final : public MlpYardstick {
public:
    OnednnMlp(const MlpProblem& problem, uint32_t threads);

    double infer() override;
    double train() override;

    std::vector<float> results() const override { return results_; }
    std::vector<float> gradients() const override { return gradients_; }
    std::vector<float> weights() const override { return weights_; }

private:
    void applyAdam();

    std::vector<float> inputs_, targets_, weights_, results_;
    std::vector<float> gradients_, firstMoments_, secondMoments_;
    std::vector<OnednnPart> parts_; // one a thread
    uint32_t step_ = 0;
    bool isPacked_ = false; // weights for inference
};

OnednnMlp::OnednnMlp(const MlpProblem& problem, uint32_t threads)
    : inputs_(problem.inputs)
    , targets_(problem.targets)
    , weights_(problem.weights)
    , results_(problem.targets.size())
    , gradients_(problem.weights.size())
    , firstMoments_(problem.weights.size())
    , secondMoments_(problem.weights.size()) {
    omp_set_num_threads(1);
    const uint32_t parts = std::min(threads, problem.rows);
    for (uint32_t i = 0; i < parts; ++i) {
        const auto first = uint32_t(uint64_t(problem.rows) * i / parts);
        const auto end = uint32_t(uint64_t(problem.rows) * (i + 1) / parts);
        parts_.emplace_back(problem.shape, OnednnBatch{inputs_, results_, targets_, weights_}, first,
                            end - first);
    }
}

double OnednnMlp::infer() {
    if (!isPacked_)
        for (OnednnPart& part : parts_) part.packForInference();
    isPacked_ = true;
    return parallelTime(uint32_t(parts_.size()), [&](uint32_t i) {
        omp_set_num_threads(1); // of this thread
        parts_[i].infer();
    });
}

double OnednnMlp::train() {
    isPacked_ = false;
    std::barrier differentiated(std::ptrdiff_t(parts_.size()));
    return parallelTime(uint32_t(parts_.size()), [&](uint32_t i) {
        omp_set_num_threads(1);
        parts_[i].differentiate();
        differentiated.arrive_and_wait();
        if (i == 0) applyAdam();
    });
}

void OnednnMlp::applyAdam() {
    const AdamConstants adam;
    ++step_;
    const float firstScale = 1.0f / (1.0f - std::pow(adam.beta1, float(step_)));
    const float secondScale = 1.0f / (1.0f - std::pow(adam.beta2, float(step_)));
    std::ranges::fill(gradients_, 0.0f);
    for (const OnednnPart& part : parts_)
        for (size_t i = 0; i < weights_.size(); ++i) gradients_[i] += part.gradients()[i];
    for (size_t i = 0; i < weights_.size(); ++i) {
        const float g = gradients_[i];
        firstMoments_[i] = adam.beta1 * firstMoments_[i] + (1.0f - adam.beta1) * g;
        secondMoments_[i] = adam.beta2 * secondMoments_[i] + (1.0f - adam.beta2) * g * g;
        weights_[i] -= adam.learningRate * firstMoments_[i] * firstScale /
                       (std::sqrt(secondMoments_[i] * secondScale) + adam.epsilon);
    }
}

} // namespace

std::unique_ptr<MlpYardstick> makeOnednnMlp(const MlpProblem& problem, uint32_t threads) {
    return std::make_unique<OnednnMlp>(problem, threads);
}

} // namespace irradia
