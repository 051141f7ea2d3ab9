// Adam (Kingma and Ba 2015) with weight decay, a decaying learning rate, a clip of the gradient's norm, and
// the exponential moving average of the parameters that predictions use (Müller 2021, 4.4).
#pragma once

#include "engine/graph/frame_graph.h"
#include "nrc/learning/config.h"
#include "shared/training.h"
#include <array>
#include <optional>
#include <span>

namespace irradia {

// What a group's `gradients` hold: floats, or the 64-bit sums of Encoding::accumulateGradient, which a step
// takes and makes zero. Of sums, a parameter whose own is exactly 0 keeps its value and moments.
enum class GradientForm { Floats, Sums };

// Parameters that are learned alike, with all that belongs to each; `count` of them, a multiple of 4.
struct ParameterGroup {
    ParameterGroup() = default;
    ParameterGroup(Device& device, const std::string& name, uint64_t count, double learningRate, double l2,
                   GradientForm form);

    // What a step depends on, and a saved model holds.
    std::array<const Buffer*, 4> learned() const {
        return {&values, &firstMoments, &secondMoments, &averages};
    }

    uint64_t count = 0;
    float learningRate = 0;
    float l2 = 0;
    GradientForm form = GradientForm::Floats;
    Buffer values, gradients, firstMoments, secondMoments, averages;
};

class Optimizer {
public:
    Optimizer(Device& device, const OptimizerConfig& config)
        : Optimizer(device, config, device.storesByAddress()) {}
    // Either form of the kernels on any device that has both, for tests.
    Optimizer(Device& device, const OptimizerConfig& config, bool byAddress);

    static gpu::TrainingState initialState();

    // One step from the groups' gradients; whether it happens, and the scale of sums, are in `state`
    // (gpu::TrainingState). The average of W_1 .. W_t with decays a_1 .. a_t weighs W_i with
    // (1 - a_i) a_(i+1) .. a_t, over the sum of these weights.
    // emaDecay: instead of the configuration's, in [0, 1); learningRate: times the groups'.
    void step(FrameGraph& graph, BufferRange state, std::span<const ParameterGroup* const> groups,
              std::optional<double> emaDecay = {}, double learningRate = 1.0) const;

private:
    // For gradients of one form.
    struct Kernels {
        Kernel norm, optimize;
    };
    const Kernels& kernelsFor(const ParameterGroup& group) const {
        return group.form == GradientForm::Sums ? forSums_ : forFloats_;
    }
    void measureNorm(FrameGraph& graph, BufferRange state,
                     std::span<const ParameterGroup* const> groups) const;

    OptimizerConfig config_;
    Kernel beginUpdate_;
    Kernels forFloats_, forSums_;
    Buffer partials_; // of the squared norm
};

} // namespace irradia
