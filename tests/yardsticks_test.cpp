// What `bench mlp` compares with computes what it should: results, gradients and steps against plain loops in
// double precision.
#include "samples/yardsticks/cpu_peak.h"
#include "samples/yardsticks/device_peak.h"
#include "samples/yardsticks/mlp_yardstick.h"
#include "tests/support/kernel_harness.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;

namespace {

struct Expected {
    std::vector<double> results;
    std::vector<double> gradients;
};

// One row after the other.
Expected plainLoops(const MlpProblem& problem) {
    const MlpShape& shape = problem.shape;
    Expected all{{}, std::vector<double>(problem.weights.size())};
    for (uint32_t row = 0; row < problem.rows; ++row) {
        const float* input = problem.inputs.data() + size_t(row) * shape.inputs;
        std::vector<std::vector<double>> values{{input, input + shape.inputs}};
        std::vector<size_t> first{0};
        for (uint32_t l = 0; l < shape.layerCount(); ++l) {
            const LayerShape size = shape.layer(l);
            std::vector<double> next(size.outputs);
            for (uint32_t o = 0; o < size.outputs; ++o) {
                for (uint32_t i = 0; i < size.inputs; ++i)
                    next[o] += problem.weights[first[l] + o * size.inputs + i] * values[l][i];
                if (l < shape.hiddenLayers) next[o] = std::max(next[o], 0.0);
            }
            values.push_back(next);
            first.push_back(first[l] + size_t(size.inputs) * size.outputs);
        }
        std::vector<double> gradient(shape.outputs);
        for (uint32_t o = 0; o < shape.outputs; ++o) {
            all.results.push_back(values.back()[o]);
            gradient[o] = 2.0 * (values.back()[o] - problem.targets[size_t(row) * shape.outputs + o]) /
                          double(problem.targets.size());
        }
        for (uint32_t l = shape.layerCount(); l-- > 0;) {
            const LayerShape size = shape.layer(l);
            std::vector<double> previous(size.inputs);
            for (uint32_t o = 0; o < size.outputs; ++o)
                for (uint32_t i = 0; i < size.inputs; ++i) {
                    const size_t weight = first[l] + o * size.inputs + i;
                    all.gradients[weight] += gradient[o] * values[l][i];
                    if (values[l][i] > 0) previous[i] += gradient[o] * problem.weights[weight];
                }
            gradient = previous;
        }
    }
    return all;
}

double largest(const std::vector<double>& values) {
    double most = 0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
}

double largestDifference(const std::vector<float>& values, const std::vector<double>& expected) {
    REQUIRE(values.size() == expected.size());
    double most = 0;
    for (size_t i = 0; i < values.size(); ++i) most = std::max(most, std::abs(values[i] - expected[i]));
    return most;
}

void checkYardstick(MlpYardstick& yardstick, const MlpProblem& problem) {
    const Expected expected = plainLoops(problem);
    // Sums of at most 64 products and 512 rows in single precision.
    const double resultLimit = 1e-5 * largest(expected.results);
    CHECK(yardstick.infer() > 0);
    CHECK(largestDifference(yardstick.results(), expected.results) < resultLimit);
    CHECK(yardstick.train() > 0);
    CHECK(largestDifference(yardstick.results(), expected.results) < resultLimit);
    CHECK(largestDifference(yardstick.gradients(), expected.gradients) < 1e-5 * largest(expected.gradients));

    // Adam's first step goes the learning rate's length against each gradient's sign.
    const std::vector<float> weights = yardstick.weights();
    size_t compared = 0;
    for (size_t i = 0; i < weights.size(); ++i) {
        if (std::abs(expected.gradients[i]) < 1e-4 * largest(expected.gradients)) continue;
        const double step = std::copysign(double(AdamConstants{}.learningRate), -expected.gradients[i]);
        CHECK(std::abs(double(weights[i]) - problem.weights[i] - step) < 1e-4);
        ++compared;
    }
    CHECK(compared > weights.size() / 4);

    // The new weights are used by both.
    MlpProblem next = problem;
    next.weights = weights;
    const Expected after = plainLoops(next);
    yardstick.infer();
    CHECK(largestDifference(yardstick.results(), after.results) < 1e-5 * largest(after.results));
    yardstick.train();
    CHECK(largestDifference(yardstick.gradients(), after.gradients) < 1e-5 * largest(after.gradients));
}

} // namespace

TEST_CASE("the textbook network is the plain loop's") {
    for (const MlpShape& shape : {MlpShape{64, 64, 5, 3}, MlpShape{32, 16, 1, 4}, MlpShape{16, 32, 2, 3}}) {
        const MlpProblem problem = makeMlpProblem(shape, 200);
        checkYardstick(*makeTextbookMlp(test::validatedDevice(), problem), problem);
    }
    CHECK(test::validatedDevice().validationMessages() == 0);
}

TEST_CASE("oneDNN's network is the plain loop's") {
    for (const MlpShape& shape : {MlpShape{64, 64, 5, 3}, MlpShape{32, 16, 1, 4}, MlpShape{16, 32, 2, 3}}) {
        const MlpProblem problem = makeMlpProblem(shape, 512);
        const auto yardstick = makeOnednnMlp(problem, 2);
        if (!yardstick) SKIP("built without oneDNN");
        checkYardstick(*yardstick, problem);
    }
}

TEST_CASE("oneDNN's batches are evaluated in parts") {
    const MlpProblem problem = makeMlpProblem({16, 16, 2, 3}, 16384);
    const auto yardstick = makeOnednnMlp(problem, 2);
    if (!yardstick) SKIP("built without oneDNN");
    yardstick->infer();
    const Expected expected = plainLoops(problem);
    CHECK(largestDifference(yardstick->results(), expected.results) < 1e-5 * largest(expected.results));
}

TEST_CASE("peaks of the machine are plausible") {
    const CpuPeak peak = measureCpuPeak(1, 0.002);
    CHECK(peak.gflops > 0.1);
    CHECK(peak.gflops < 2000); // a thread; a core does 64 flops a cycle at most today
    CHECK_FALSE(peak.form.empty());
    CHECK(measureDevicePeak(test::validatedDevice(), 0.002) > 0.1);
    const double copied = measureCopyBandwidth(1);
    CHECK(copied > 0.1);
    CHECK(copied < 2000);
}
