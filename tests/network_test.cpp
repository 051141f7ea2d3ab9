// Network: both forms and precisions against the double-precision twin, derivatives by central differences,
// and what must not change a bit.
#include "shared/network.h"
#include "tests/reference/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/kernel_harness.h"
#include "tests/support/network_comparison.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using namespace irradia::test;

namespace {

// Relative to the largest value of the same matrix. Single: sums of up to 128 products err by about the root
// of that times 2^-24 of their terms' magnitudes, nine layers deep (7e-7 is the worst seen). Half: what a
// pass keeps is rounded as in the twin, but where sums differ in their last bits it may round the other way,
// by 2^-10.
double tolerance(Precision precision) {
    return precision == Precision::Half ? 2e-3 : 3e-6;
}

// Content that is not to be used: 3156.33, or 5.27 twice in half precision.
const double kGarbage = std::bit_cast<float>(0x45454545u);

constexpr NetworkForm kForms[] = {NetworkForm::Subgroup, NetworkForm::Workgroup};
constexpr Precision kPrecisions[] = {Precision::Float, Precision::Half};
constexpr OutputActivation kActivations[] = {OutputActivation::None, OutputActivation::ReLU,
                                             OutputActivation::Exponential, OutputActivation::Softplus};

// Every width in both forms and precisions, at random depths, inputs and outputs (at other subgroup sizes
// than the usual eight a few: compiling is most of the time); or each width and depth with each number of
// inputs and outputs.
std::vector<NetworkCase> cases() {
    const uint32_t widths[] = {16, 32, 64, 128}, outputs[] = {1, 3, 4, 16}, inputs[] = {16, 32, 48, 64, 80};
    std::vector<NetworkCase> all;
    for (const uint32_t width : widths)
        for (uint32_t hidden = 1; hidden <= 8; ++hidden)
            for (const uint32_t out : outputs)
                for (const uint32_t in : inputs) {
                    const size_t turn = all.size() + hidden; // so that all combinations occur
                    all.push_back({in, width, hidden, out, kActivations[turn / 4 % 4], kPrecisions[turn % 2],
                                   kForms[turn / 2 % 2]});
                }
    if (fullSweep()) return all;
    reference::Random random(1);
    std::vector<NetworkCase> some;
    for (size_t i = 0; i < (validatedDevice().subgroupSize() == 8 ? 16 : 4); ++i) {
        const double share = (static_cast<double>((i + i / 4) % 4) + random.uniform()) / 4.0;
        NetworkCase picked = all[static_cast<size_t>(share * static_cast<double>(all.size()))];
        picked.precision = kPrecisions[i % 2];
        picked.form = kForms[i / 2 % 2];
        some.push_back(picked);
    }
    return some;
}

NetworkCase small(Precision precision, NetworkForm form) {
    return {32, 32, 3, 3, OutputActivation::None, precision, form};
}

// Calls use(shape) for a small shape in each form and precision.
template <typename Use>
void forEachKind(Use&& use) {
    for (const NetworkForm form : kForms)
        for (const Precision precision : kPrecisions) {
            const NetworkCase shape = small(precision, form);
            INFO(shape.name());
            use(shape);
        }
}

} // namespace

TEST_CASE("passes are those of the twin") {
    for (const NetworkCase& shape : cases()) {
        NetworkHarness harness(shape, 0, 512, kGarbage);
        const std::vector<double> weights = harness.randomWeights(shape.hidden);
        harness.setWeights(weights);
        const NetworkBatch batch = harness.randomBatch(257, shape.inputs);
        const NetworkOutputs outputs = harness.run(batch);
        const NetworkErrors errors = compareWithTwin(harness, weights, batch, outputs);
        INFO(shape.name() << ": " << errors.text());
        CHECK(errors.worst() <= tolerance(shape.precision));
        CHECK(outputs.inferred == outputs.results);
        CHECK(harness.network().sharedBytes() <= validatedDevice().limits().maxComputeSharedMemorySize);
    }
}

TEST_CASE("the forms agree") {
    for (const Precision precision : kPrecisions) {
        NetworkOutputs outputs[2];
        for (size_t f = 0; f < 2; ++f) {
            NetworkHarness harness(small(precision, kForms[f]));
            harness.setWeights(harness.randomWeights(13));
            outputs[f] = harness.run(harness.randomBatch(257, 14));
            if (f == 0) continue;
            const NetworkErrors errors = compareRuns(harness, outputs[1], outputs[0]);
            INFO(errors.text());
            // In half precision one form hands on what the other one rounds (2^-11, three layers deep), and
            // near its kink ReLU makes a whole derivative of that: gradients are the twin's in each form
            // instead.
            if (precision == Precision::Half)
                CHECK(errors.results <= 4e-3);
            else
                CHECK(errors.worst() <= 2.0 * tolerance(precision));
        }
    }
}

TEST_CASE("a wrong weight, gradient or row is found") {
    const NetworkCase shape = small(Precision::Half, NetworkForm::Subgroup);
    NetworkHarness harness(shape);
    std::vector<double> weights = harness.randomWeights(1);
    harness.setWeights(weights);
    NetworkBatch batch = harness.randomBatch(64, 2);
    NetworkOutputs outputs = harness.run(batch);
    const double limit = tolerance(shape.precision);
    REQUIRE(compareWithTwin(harness, weights, batch, outputs).worst() <= limit);

    outputs.weightGradient[40] *= 1.05;
    outputs.weightGradient[40] += 0.05;
    CHECK(compareWithTwin(harness, weights, batch, outputs).weightGradient > limit);
    std::swap(weights[33], weights[65]);
    CHECK(compareWithTwin(harness, weights, batch, outputs).activations > limit);
    std::swap(weights[33], weights[65]);
    std::swap(batch.resultGradient[0], batch.resultGradient[1]);
    CHECK(compareWithTwin(harness, weights, batch, outputs).inputGradient > limit);
}

namespace {

// Half the sum of squared errors: a scalar whose gradient by the results is their error.
double scalar(const std::vector<double>& results, const std::vector<double>& targets) {
    double sum = 0.0;
    for (size_t i = 0; i < results.size(); ++i) sum += 0.5 * std::pow(results[i] - targets[i], 2);
    return sum;
}

// Rows of which no hidden neuron lies close to the kink of ReLU.
NetworkBatch batchAwayFromKinks(const NetworkHarness& harness, const std::vector<double>& weights,
                                uint32_t count) {
    constexpr double kMargin = 0.03;
    NetworkBatch batch{count, {}, std::vector<double>(size_t{count} * harness.shape().outputs)};
    for (uint64_t seed = 0; batch.encoded.size() < size_t{count} * harness.shape().inputs; ++seed) {
        const std::vector<double> row = harness.randomBatch(1, seed).encoded;
        if (harness.twin().forward(weights, row).margin > kMargin)
            batch.encoded.insert(batch.encoded.end(), row.begin(), row.end());
    }
    return batch;
}

// Weights of a matrix to be tested: some of its used ones, from all over it.
std::vector<size_t> someWeights(const reference::Matrix& matrix, size_t usedRows) {
    std::vector<size_t> some;
    const size_t count = usedRows * matrix.columns;
    for (size_t i = 0; i < 16; ++i) some.push_back(matrix.offset + (i * 37 + i * count / 16) % count);
    return some;
}

// Largest error of the kernels' gradient by weights of the matrix, relative to the largest derivative. The
// scalar is (nearly) quadratic in one weight, so that a large step is exact: 2^-6 moves no neuron across its
// kink, and single precision's noise of some 1e-6 in the scalar becomes some 1e-4.
double differenceError(NetworkHarness& harness, std::vector<double> weights, const NetworkBatch& batch,
                       const std::vector<double>& targets, const std::vector<double>& gradient,
                       const std::vector<size_t>& which) {
    constexpr double kStep = 0x1p-6;
    const auto at = [&](size_t i, double step) {
        weights[i] += step;
        harness.setWeights(weights);
        weights[i] -= step;
        return scalar(harness.infer(batch), targets);
    };
    double worst = 0.0, largest = 0.0;
    for (const size_t i : which) {
        const double difference = (at(i, kStep) - at(i, -kStep)) / (2.0 * kStep);
        worst = std::max(worst, std::abs(gradient[i] - difference));
        largest = std::max(largest, std::abs(difference));
    }
    return worst / largest;
}

} // namespace

TEST_CASE("gradients of every matrix agree with central differences of the kernels' own results") {
    constexpr double kTolerance = 2e-3;
    for (const NetworkForm form : kForms)
        for (const OutputActivation output : {OutputActivation::None, OutputActivation::Softplus}) {
            NetworkCase shape = small(Precision::Float, form);
            shape.output = output;
            NetworkHarness harness(shape);
            const std::vector<double> weights = harness.randomWeights(3);
            NetworkBatch batch = batchAwayFromKinks(harness, weights, 8);
            const std::vector<double> targets = harness.randomBatch(8, 4).resultGradient;
            harness.setWeights(weights);
            const std::vector<double> results = harness.infer(batch);
            for (size_t i = 0; i < results.size(); ++i) batch.resultGradient[i] = results[i] - targets[i];
            std::vector<double> gradient = harness.run(batch).weightGradient;

            const auto matrices = harness.twin().matrices();
            for (size_t m = 0; m < matrices.size(); ++m) {
                const auto which = someWeights(matrices[m], m + 1 < matrices.size() ? 32 : 3);
                INFO(shape.name() << ", matrix " << m);
                CHECK(differenceError(harness, weights, batch, targets, gradient, which) < kTolerance);
                if (m > 0) continue;
                gradient[which[2]] += 0.01 * (1.0 + std::abs(gradient[which[2]])); // planted
                CHECK(differenceError(harness, weights, batch, targets, gradient, which) > kTolerance);
            }
        }
}

TEST_CASE("results have the same bits whatever the number of rows a lane takes") {
    for (const Precision precision : kPrecisions) {
        std::vector<NetworkOutputs> outputs;
        for (uint32_t rowsPerLane = 0; rowsPerLane <= 4; ++rowsPerLane) {
            NetworkHarness harness(small(precision, NetworkForm::Subgroup), rowsPerLane, 512, kGarbage);
            harness.setWeights(harness.randomWeights(5));
            outputs.push_back(harness.run(harness.randomBatch(300, 6)));
            INFO(harness.shape().name() << ", " << rowsPerLane << " rows a lane");
            CHECK(outputs.back().inferred == outputs.back().results);
            CHECK(outputs.back() == outputs.front());
        }
    }
}

TEST_CASE("any number of rows, of which no other row or old content changes a bit") {
    forEachKind([](const NetworkCase& shape) {
        NetworkHarness clean(shape), garbage(shape, 0, 512, kGarbage);
        const std::vector<double> weights = clean.randomWeights(7);
        clean.setWeights(weights);
        garbage.setWeights(weights);
        for (const uint32_t count : {0u, 1u, 7u, 8u, 255u, 256u, 257u, 512u}) {
            INFO(count << " rows");
            const NetworkBatch batch = clean.randomBatch(count, 8);
            const NetworkOutputs outputs = clean.run(batch);
            CHECK(outputs == garbage.run(batch));
            const double* unused = &outputs.weightGradient[outputs.weightGradient.size() - 13 * 32];
            CHECK(std::all_of(unused, unused + 13 * 32, [](double g) { return g == 0.0; }));
            CHECK(compareWithTwin(clean, weights, batch, outputs).worst() <= tolerance(shape.precision));
        }
    });
}

TEST_CASE("the same rows give the same bits again") {
    forEachKind([](const NetworkCase& shape) {
        NetworkHarness harness(shape);
        harness.setWeights(harness.randomWeights(9));
        const NetworkBatch batch = harness.randomBatch(511, 10);
        const NetworkOutputs outputs = harness.run(batch);
        for (int i = 0; i < 5; ++i) CHECK(harness.run(batch) == outputs);
    });
}

TEST_CASE("weight gradients are multiplied by the scale") {
    forEachKind([](const NetworkCase& shape) {
        NetworkHarness harness(shape);
        harness.setWeights(harness.randomWeights(11));
        const NetworkBatch batch = harness.randomBatch(100, 12);
        const NetworkOutputs outputs = harness.run(batch);
        std::vector<double> quarter = outputs.weightGradient;
        for (double& g : quarter) g *= 0.25;
        CHECK(harness.run(batch, 0.25f).weightGradient == quarter);
    });
}

TEST_CASE("sizes, shared memory, and shapes that are refused") {
    const NetworkHarness harness({48, 64, 5, 3});
    const Network& network = harness.network();
    CHECK(network.weightCount() == 48 * 64 + 4 * 64 * 64 + 64 * 16);
    CHECK(network.multiplyAdds() == 48 * 64 + 4 * 64 * 64 + 64 * 3);
    CHECK(network.outputQuads() == 1);
    CHECK(network.config().form == NetworkForm::Subgroup);
    const auto refused = [](const char* named, auto change, uint32_t inputs, uint32_t outputs) {
        NetworkConfig config;
        change(config);
        expectError(ExitCode::BadData, named, [&] { Network(validatedDevice(), config, inputs, outputs); });
    };
    const auto nothing = [](NetworkConfig&) {};
    refused("17", nothing, 17, 3);
    refused("17", nothing, 16, 17);
    refused("0", nothing, 16, 0);
    refused(
        "48", [](NetworkConfig& c) { c.width = 48; }, 16, 3);
    refused(
        "9", [](NetworkConfig& c) { c.hiddenLayers = 9; }, 16, 3);
}

TEST_CASE("initial weights fill Glorot's range evenly and follow the seed") {
    const NetworkHarness harness({32, 64, 3, 16});
    const Network& network = harness.network();
    std::vector<float> weights(network.weightCount()), again = weights, other = weights;
    network.initialise(weights, 1);
    network.initialise(again, 1);
    network.initialise(other, 2);
    CHECK(weights == again);
    CHECK(weights != other);
    for (const reference::Matrix& m : harness.twin().matrices()) {
        const double bound = std::sqrt(6.0 / static_cast<double>(m.rows + m.columns));
        const auto count = static_cast<double>(m.rows * m.columns);
        double sum = 0.0, squares = 0.0, largest = 0.0;
        for (size_t i = m.offset; i < m.offset + m.rows * m.columns; ++i) {
            const double w = weights[i] / bound;
            sum += w / count;
            squares += w * w / count;
            largest = std::max(largest, std::abs(w));
        }
        // Five deviations of the mean (variance 1/3) and of the mean square (variance 4/45).
        CHECK(std::abs(sum) < 5.0 * std::sqrt(1.0 / 3.0 / count));
        CHECK(std::abs(squares - 1.0 / 3.0) < 5.0 * std::sqrt(4.0 / 45.0 / count));
        CHECK(largest <= 1.0 + 1e-6);
        CHECK(largest > 1.0 - 10.0 / count); // missed with a chance of e^-10
    }
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(validatedDevice().validationMessages() == 0);
}
