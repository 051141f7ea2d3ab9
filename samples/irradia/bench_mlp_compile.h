// How long the first execution of each kernel takes, with an empty shader cache and with a full one.
#pragma once

#include "bench_mlp_cases.h"
#include "engine/gpu/device.h"

namespace irradia {

// In place of a kernel: making all pipelines of a case, before the first pass.
inline constexpr const char* kPipelines = "(all pipelines)";

struct CompileTime {
    MlpCase what;
    std::string kernel; // a pass, or kPipelines
    double cold = 0;    // seconds
    double cached = 0;
};

// Points Mesa's shader cache at a new folder, which it removes, and opens the device twice.
std::vector<CompileTime> measureCompileTimes(const DeviceOptions& options, const std::vector<MlpCase>& cases);

} // namespace irradia
