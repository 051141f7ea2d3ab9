// A network that `bench mlp` compares the project's own with.
#pragma once

#include "samples/yardsticks/mlp_problem.h"
#include <memory>

namespace irradia {

class MlpYardstick {
public:
    virtual ~MlpYardstick() = default;

    // Wall-clock seconds of evaluating all rows.
    virtual double infer() = 0;
    // Wall-clock seconds of a step: forward, loss, backward, the weights' gradient, Adam.
    virtual double train() = 0;

    virtual std::vector<float> results() const = 0;   // rows x outputs, of the last of either
    virtual std::vector<float> gradients() const = 0; // by the weights, of the last step
    virtual std::vector<float> weights() const = 0;
};

class Device;

// As first written in a compute shader: private arrays, weights in a storage buffer, plain loops.
std::unique_ptr<MlpYardstick> makeTextbookMlp(Device& device, const MlpProblem& problem);

// By oneDNN's primitives on as many threads; none where the build found no oneDNN.
std::unique_ptr<MlpYardstick> makeOnednnMlp(const MlpProblem& problem, uint32_t threads);

} // namespace irradia
