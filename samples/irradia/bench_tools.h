// What the benchmarks of networks share: medians over rounds, the number of threads, JSON to a file or
// stdout.
#pragma once

#include "engine/gpu/device.h"
#include <chrono>
#include <nlohmann/json_fwd.hpp>

namespace irradia {

double median(std::vector<double> values); // of at least one

// What run() returned each time: short runs are repeated for 15 ms.
template <typename Run>
auto repeated(const Run& run) {
    constexpr double kSeconds = 0.015;
    constexpr size_t kRuns = 50;
    std::vector<decltype(run())> times;
    const auto start = std::chrono::steady_clock::now();
    do times.push_back(run());
    while (times.size() < kRuns &&
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < kSeconds);
    return times;
}

// The threads a CPU device runs on (lavapipe's variable), to give its yardsticks the same.
uint32_t cpuThreads(const Device& device);

// "-" is stdout.
void writeJson(const std::string& file, const nlohmann::ordered_json& json);

} // namespace irradia
