// What the networks of `bench mlp` are asked: a multilayer perceptron with hidden layers of one width with
// ReLU, no bias, a linear output layer, and the mean squared error of a batch as loss.
#pragma once

#include <cstdint>
#include <vector>

namespace irradia {

struct LayerShape {
    uint32_t inputs = 0;
    uint32_t outputs = 0;
};

struct MlpShape {
    uint32_t inputs = 64;
    uint32_t width = 64;
    uint32_t hiddenLayers = 5;
    uint32_t outputs = 3;

    uint32_t layerCount() const { return hiddenLayers + 1; }
    LayerShape layer(uint32_t index) const {
        return {index == 0 ? inputs : width, index == hiddenLayers ? outputs : width};
    }
    // Of a row, as many as there are weights.
    uint64_t multiplyAdds() const {
        return uint64_t(width) * (inputs + (hiddenLayers - 1) * uint64_t(width) + outputs);
    }
};

// A batch in plain rows, and the weights to begin with: matrix after matrix, each with rows of outputs.
struct MlpProblem {
    MlpShape shape;
    uint32_t rows = 0;
    std::vector<float> inputs;  // rows x shape.inputs
    std::vector<float> targets; // rows x shape.outputs
    std::vector<float> weights; // shape.multiplyAdds()
};

// Uniform inputs, smooth targets of them, weights as Glorot and Bengio (2010); always the same.
MlpProblem makeMlpProblem(const MlpShape& shape, uint32_t rows);

// Its first rows, as many as there are.
MlpProblem firstRows(const MlpProblem& problem, uint32_t rows);

// Adam (Kingma and Ba 2015) as the yardsticks apply it.
struct AdamConstants {
    float learningRate = 1e-2f;
    float beta1 = 0.9f;
    float beta2 = 0.99f;
    float epsilon = 1e-8f;
};

} // namespace irradia
