// A Network run on rows given and returned as plain matrices, and its twin of the reference.
#pragma once

#include "nrc/learning/network.h"
#include "tests/reference/network.h"
#include "tests/support/network_rows.h"

namespace irradia::test {

struct NetworkCase {
    uint32_t inputs = 16, width = 16, hidden = 1, outputs = 1;
    OutputActivation output = OutputActivation::None;
    Precision precision = Precision::Float;
    NetworkForm form = NetworkForm::Subgroup;

    std::string name() const;
};

// As the kernels see them: rounded to the precision in which they are stored.
struct NetworkBatch {
    uint32_t count = 0;
    std::vector<double> encoded;        // count x inputs
    std::vector<double> resultGradient; // count x outputs
};

struct NetworkOutputs {
    std::vector<double> inferred, results; // count x outputs
    std::vector<double> activations;       // count x (hidden * width)
    std::vector<double> inputGradient;     // count x inputs
    std::vector<double> weightGradient;

    bool operator==(const NetworkOutputs&) const = default;
};

class NetworkHarness {
public:
    // `filling`: of everything that the kernels are not to use: rows beyond a batch's count, padding, old
    // content.
    explicit NetworkHarness(const NetworkCase& shape, uint32_t rowsPerLane = 0, uint32_t capacity = 512,
                            double filling = 0.0);

    const NetworkCase& shape() const { return shape_; }
    const Network& network() const { return network_; }
    reference::Mlp twin() const;

    // Uniform weights that keep the size of activations from layer to layer (He et al. 2015, eq. 10).
    std::vector<double> randomWeights(uint64_t seed) const;
    void setWeights(const std::vector<double>& weights);

    NetworkBatch randomBatch(uint32_t count, uint64_t seed) const;
    // Infers, and goes forward and back. The weights' gradient is multiplied by `scale`.
    NetworkOutputs run(const NetworkBatch& batch, float scale = 1.0f);
    std::vector<double> infer(const NetworkBatch& batch);

private:
    RowFormat encodedRows() const { return {shape_.inputs, shape_.precision}; }
    RowFormat resultRows() const { return {shape_.outputs, Precision::Float}; }
    RowFormat activationRows() const { return {shape_.hidden * shape_.width, shape_.precision}; }
    RowCount rows(uint32_t count);
    Buffer used(const char* name, uint64_t bytes) const; // a buffer with old content

    NetworkCase shape_;
    uint32_t capacity_;
    double filling_;
    Network network_;
    Buffer weights_, packed_, counters_;
};

} // namespace irradia::test
