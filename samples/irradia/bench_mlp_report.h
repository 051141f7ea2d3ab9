// The results of `bench mlp` as a table and as JSON.
#pragma once

#include "bench_mlp_compile.h"
#include "bench_mlp_rounds.h"
#include <nlohmann/json_fwd.hpp>

namespace irradia {

// What the results were measured on, in the same run.
struct MlpMachine {
    std::string device;
    uint32_t threads = 0;
    uint32_t subgroup = 0;
    double copyGbps = 0; // 0 where it is not known
};

void printHeading(const MlpMachine& machine);
void printResults(const std::vector<MlpResult>& results, bool withPasses);
void printCompileTimes(const std::vector<CompileTime>& times);

nlohmann::ordered_json toJson(const std::vector<MlpResult>& results, const MlpMachine& machine);
nlohmann::ordered_json toJson(const std::vector<CompileTime>& times, const std::string& device);

} // namespace irradia
