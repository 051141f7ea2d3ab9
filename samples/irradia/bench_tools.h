// What the benchmarks of networks share: medians over rounds, the number of threads, JSON to a file or
// stdout.
#pragma once

#include "engine/gpu/device.h"
#include <nlohmann/json_fwd.hpp>

namespace irradia {

double median(std::vector<double> values); // of at least one

// The threads a CPU device runs on (lavapipe's variable), to give its yardsticks the same.
uint32_t cpuThreads(const Device& device);

// "-" is stdout.
void writeJson(const std::string& file, const nlohmann::ordered_json& json);

} // namespace irradia
