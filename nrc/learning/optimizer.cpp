#include "nrc/learning/optimizer.h"

#include "kernels/learning.h"
#include <algorithm>

namespace irradia {
namespace {

constexpr size_t kMostGroups = 2; // weights and features

Buffer floats(Device& device, const std::string& name, uint64_t count) {
    return Buffer(device, name, std::max<uint64_t>(count, 4) * sizeof(float));
}

} // namespace

ParameterGroup::ParameterGroup(Device& device, const std::string& name, uint64_t parameters, double rate,
                               double weightDecay, GradientForm gradientForm)
    : count(parameters)
    , learningRate(static_cast<float>(rate))
    , l2(static_cast<float>(weightDecay))
    , form(gradientForm)
    , values(floats(device, name, parameters))
    , gradients(floats(device, name + " gradients", form == GradientForm::Sums ? 2 * parameters : parameters))
    , firstMoments(floats(device, name + " first moments", parameters))
    , secondMoments(floats(device, name + " second moments", parameters))
    , averages(floats(device, name + " averages", parameters)) {}

Optimizer::Optimizer(Device& device, const OptimizerConfig& config, bool byAddress)
    : config_(config)
    , beginUpdate_(device, kernels::begin_update)
    , partials_(device, "squared norm", kMostGroups * gpu::kNormPartials * sizeof(float)) {
    forFloats_ = {{device, kernels::gradient_norm},
                  {device, byAddress ? kernels::optimize_by_address : kernels::optimize}};
    forSums_ = {{device, kernels::gradient_norm_from_sums},
                {device, byAddress ? kernels::optimize_from_sums_by_address : kernels::optimize_from_sums}};
}

gpu::TrainingState Optimizer::initialState() {
    gpu::TrainingState state{};
    state.learningRateFactor = 1;
    state.clipScale = 1;
    return state;
}

void Optimizer::measureNorm(FrameGraph& graph, BufferRange state,
                            std::span<const ParameterGroup* const> groups) const {
    uint32_t first = 0;
    for (const ParameterGroup* group : groups) {
        const gpu::NormParams params{static_cast<uint32_t>(group->count / 4), first};
        graph.pass(kernelsFor(*group).norm, "gradient_norm")
            .read(state)
            .read(group->gradients)
            .write(partials_)
            .push(params)
            .dispatchGroups(gpu::kNormPartials);
        first += gpu::kNormPartials;
    }
}

void Optimizer::step(FrameGraph& graph, BufferRange state, std::span<const ParameterGroup* const> groups,
                     std::optional<double> decay, double learningRate) const {
    const bool clips = config_.clipNorm > 0;
    if (clips) measureNorm(graph, state, groups);
    const auto beta1 = static_cast<float>(config_.beta1), beta2 = static_cast<float>(config_.beta2);
    const auto emaDecay = static_cast<float>(decay.value_or(config_.emaDecay));
    const gpu::BeginUpdateParams begin{clips ? static_cast<uint32_t>(groups.size()) * gpu::kNormPartials : 0u,
                                       static_cast<float>(config_.clipNorm),
                                       beta1,
                                       beta2,
                                       emaDecay,
                                       static_cast<float>(config_.decayBase),
                                       config_.decayStart,
                                       config_.decayInterval,
                                       config_.decayEnd};
    graph.pass(beginUpdate_).readWrite(state).read(partials_).push(begin).dispatchGroups(1);
    for (const ParameterGroup* group : groups) {
        const gpu::OptimizeParams params{static_cast<uint32_t>(group->count / 4),
                                         group->learningRate * static_cast<float>(learningRate),
                                         beta1,
                                         beta2,
                                         static_cast<float>(config_.epsilon),
                                         group->l2,
                                         emaDecay,
                                         0,
                                         BufferRange(group->values).address(),
                                         BufferRange(group->firstMoments).address(),
                                         BufferRange(group->secondMoments).address(),
                                         BufferRange(group->averages).address(),
                                         BufferRange(group->gradients).address()};
        Pass pass = graph.pass(kernelsFor(*group).optimize, "optimize");
        pass.readWrite(state);
        if (group->form == GradientForm::Sums)
            pass.readWrite(group->gradients);
        else
            pass.read(group->gradients);
        pass.readWrite(group->values)
            .readWrite(group->firstMoments)
            .readWrite(group->secondMoments)
            .readWrite(group->averages)
            .push(params)
            .dispatch(params.quads);
    }
}

} // namespace irradia
