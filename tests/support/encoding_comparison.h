// What an encoding's kernels gave, against the twin.
#pragma once

#include "tests/support/encoding_harness.h"

namespace irradia::test {

// Largest error of encoded rows in shares of what rounding may do, so that 1 is too much; infinite where a
// value is no number, or one between the parts is not 1.
double encodingError(const EncodingHarness& harness, const EncodingBatch& batch,
                     const std::vector<double>& features, const std::vector<double>& encoded);

std::vector<double> twinGradient(const EncodingHarness& harness, const EncodingBatch& batch);

// Infinite where sizes differ or a value is no number.
double largestDifference(const std::vector<double>& a, const std::vector<double>& b);

} // namespace irradia::test
