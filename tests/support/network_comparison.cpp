#include "tests/support/network_comparison.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace irradia::test {

namespace {

using reference::Matrix;
using reference::Mlp;

std::vector<double> part(const std::vector<double>& values, size_t first, size_t count) {
    const auto begin = values.begin() + static_cast<ptrdiff_t>(first);
    return {begin, begin + static_cast<ptrdiff_t>(count)};
}

void append(std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

Mlp::Activations activationsOf(const Mlp& twin, const std::vector<double>& weights, const NetworkBatch& batch,
                               const NetworkOutputs& outputs, size_t row) {
    Mlp::Activations made;
    made.layers.push_back(part(batch.encoded, row * twin.inputs, twin.inputs));
    for (size_t l = 0; l < twin.hiddenLayers; ++l)
        made.layers.push_back(
            part(outputs.activations, (row * twin.hiddenLayers + l) * twin.width, twin.width));
    made.z = twin.forward(weights, made.layers.front()).z;
    if (twin.output == reference::Activation::ReLU)
        made.z = part(outputs.results, row * twin.outputs, twin.outputs);
    return made;
}

} // namespace

double worstError(const std::vector<double>& actual, const std::vector<double>& expected, double scale) {
    if (actual.size() != expected.size()) return INFINITY;
    double worst = 0.0, largest = std::max(scale, 1e-300);
    for (size_t i = 0; i < expected.size(); ++i) {
        const double error = std::abs(actual[i] - expected[i]);
        worst = std::max(worst, std::isnan(error) ? INFINITY : error);
        largest = std::max(largest, std::abs(expected[i]));
    }
    return worst / largest;
}

double NetworkErrors::worst() const {
    return std::max({results, activations, inputGradient, weightGradient});
}

std::string NetworkErrors::text() const {
    return fmt::format("results {:.1e}, activations {:.1e}, input gradient {:.1e}, weight gradient {:.1e}",
                       results, activations, inputGradient, weightGradient);
}

NetworkErrors compareRuns(const NetworkHarness& harness, const NetworkOutputs& actual,
                          const NetworkOutputs& expected) {
    NetworkErrors errors{worstError(actual.results, expected.results),
                         worstError(actual.activations, expected.activations),
                         worstError(actual.inputGradient, expected.inputGradient)};
    for (const Matrix& m : harness.twin().matrices())
        errors.weightGradient = std::max(
            errors.weightGradient, worstError(part(actual.weightGradient, m.offset, m.rows * m.columns),
                                              part(expected.weightGradient, m.offset, m.rows * m.columns)));
    return errors;
}

NetworkErrors compareWithTwin(const NetworkHarness& harness, const std::vector<double>& weights,
                              const NetworkBatch& batch, const NetworkOutputs& outputs) {
    const Mlp twin = harness.twin();
    NetworkOutputs expected;
    double largestSum = 0.0;
    expected.weightGradient.assign(weights.size(), 0.0);
    for (size_t row = 0; row < batch.count; ++row) {
        const auto forward = twin.forward(weights, part(batch.encoded, row * twin.inputs, twin.inputs));
        append(expected.results, forward.results);
        for (const double z : forward.z) largestSum = std::max(largestSum, std::abs(z));
        for (size_t l = 1; l < forward.layers.size(); ++l) append(expected.activations, forward.layers[l]);
        append(expected.inputGradient,
               twin.backward(weights, activationsOf(twin, weights, batch, outputs, row),
                             part(batch.resultGradient, row * twin.outputs, twin.outputs),
                             expected.weightGradient));
    }
    NetworkErrors errors = compareRuns(harness, outputs, expected);
    if (twin.output == reference::Activation::ReLU)
        errors.results = worstError(outputs.results, expected.results, largestSum);
    return errors;
}

} // namespace irradia::test
