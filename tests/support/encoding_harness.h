// An Encoding run on rows given and returned as plain matrices, with its twin.
#pragma once

#include "nrc/learning/encoding.h"
#include "tests/support/encoding_twin.h"
#include "tests/support/network_rows.h"

namespace irradia::test {

struct EncodingCase {
    std::vector<EncodingConfig> parts;
    uint32_t inputs = 3;
    Precision precision = Precision::Float;
    std::vector<glm::vec3> touched{}; // of sparse grids

    std::string name() const;
};

// As the kernels see them: rounded to the precision in which they are stored.
struct EncodingBatch {
    uint32_t count = 0;
    std::vector<double> inputs;          // count x inputs
    std::vector<double> encodedGradient; // count x width
};

class EncodingHarness {
public:
    // `filling`: of everything that the kernels are not to use: rows beyond a batch's count, padding, old
    // content.
    explicit EncodingHarness(const EncodingCase& made, double filling = 0.0, uint32_t capacity = 512,
                             Device& device = validatedDevice());

    const Encoding& encoding() const { return encoding_; }
    const EncodingTwin& twin() const { return twin_; }
    Precision precision() const { return precision_; }

    // Inputs in -1/4 .. 5/4, or unit vectors where spherical harmonics take them; gradients in -1 .. 1.
    EncodingBatch randomBatch(uint32_t count, uint64_t seed) const;
    std::vector<double> randomFeatures(uint64_t seed) const; // in -1 .. 1

    std::vector<double> encode(const EncodingBatch& batch,
                               const std::vector<double>& features); // count x width

    // Adds to the sums of earlier batches.
    void accumulate(const EncodingBatch& batch, uint32_t times = 1);
    // The sums, which are zero then.
    std::vector<double> takeGradient();
    std::vector<double> gradient(const EncodingBatch& batch);

private:
    RowFormat inputRows() const { return {encoding_.inputs(), Precision::Float}; }
    RowFormat encodedRows() const { return {encoding_.width(), precision_}; }
    RowCount rows(uint32_t count);

    Device& device_;
    Precision precision_;
    double filling_;
    uint32_t capacity_;
    Encoding encoding_;
    EncodingTwin twin_;
    Buffer counters_, sums_;
};

} // namespace irradia::test
