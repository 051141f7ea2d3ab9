#include "samples/yardsticks/mlp_problem.h"
#include <algorithm>
#include <cmath>
#include <random>

namespace irradia {

MlpProblem makeMlpProblem(const MlpShape& shape, uint32_t rows) {
    MlpProblem problem;
    problem.shape = shape;
    problem.rows = rows;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    problem.inputs.resize(size_t(rows) * shape.inputs);
    std::ranges::generate(problem.inputs, [&] { return unit(random); });
    for (uint32_t row = 0; row < rows; ++row) {
        const float* input = problem.inputs.data() + size_t(row) * shape.inputs;
        for (uint32_t o = 0; o < shape.outputs; ++o)
            problem.targets.push_back(0.5f + 0.5f * std::sin(4.0f * input[o % shape.inputs] +
                                                             2.0f * input[(o + 1) % shape.inputs]));
    }
    for (uint32_t l = 0; l < shape.layerCount(); ++l) {
        const LayerShape size = shape.layer(l);
        const float bound = std::sqrt(6.0f / float(size.inputs + size.outputs));
        for (uint32_t i = 0; i < size.inputs * size.outputs; ++i)
            problem.weights.push_back(bound * (2.0f * unit(random) - 1.0f));
    }
    return problem;
}

MlpProblem firstRows(const MlpProblem& problem, uint32_t rows) {
    MlpProblem part = problem;
    part.rows = std::min(rows, problem.rows);
    part.inputs.resize(size_t(part.rows) * problem.shape.inputs);
    part.targets.resize(size_t(part.rows) * problem.shape.outputs);
    return part;
}

} // namespace irradia
