// What a network's kernels gave, against the twin.
#pragma once

#include "tests/support/network_harness.h"

namespace irradia::test {

// Largest difference relative to the largest expected value, or to `scale` where that is larger; infinite
// where sizes differ or a value is no number.
double worstError(const std::vector<double>& actual, const std::vector<double>& expected, double scale = 0.0);

struct NetworkErrors {
    double results = 0.0, activations = 0.0, inputGradient = 0.0;
    double weightGradient = 0.0; // of the worst matrix

    double worst() const;
    std::string text() const;
};

// The twin goes forward by itself, and back from the kernels' activations: near the kink of ReLU a last bit
// decides about a whole derivative, and it must be the same bit. Results behind a ReLU are relative to the
// largest sum before it: the few that it leaves may be small, and err as those sums do.
NetworkErrors compareWithTwin(const NetworkHarness& harness, const std::vector<double>& weights,
                              const NetworkBatch& batch, const NetworkOutputs& outputs);

// The same between two runs.
NetworkErrors compareRuns(const NetworkHarness& harness, const NetworkOutputs& actual,
                          const NetworkOutputs& expected);

} // namespace irradia::test
