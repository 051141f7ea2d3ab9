// Bytes that a row costs between the processor and memory.
#pragma once

#include "bench_mlp_cases.h"

namespace irradia {

struct RowTraffic {
    double fused = 0;   // inputs, results, and in training what its three passes hand on
    double unfused = 0; // with a kernel a layer, ReLU fused into it: activations written and read by each
};

// Counted, not measured: each array once per pass that reads or writes it, the weights once a batch.
RowTraffic trafficOf(const MlpCase& what, uint32_t rows);

} // namespace irradia
