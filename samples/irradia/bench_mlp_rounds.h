// The rounds of `bench mlp`: the forms and precisions of one network and its yardsticks, one after the other,
// again and again.
#pragma once

#include "bench_mlp_cases.h"
#include "engine/gpu/device.h"
#include <optional>

namespace irradia {

// One shape, evaluated or trained, in several forms and precisions.
struct MlpGroup {
    MlpShape shape;
    bool isTraining = false;
    uint32_t rows = 0;
    std::vector<NetworkForm> forms;
    std::vector<Precision> precisions;
    uint32_t rowsPerLane = 0;
};

// Medians over the rounds; a ratio's is that of the rounds' ratios, and above 1 where the case is the faster
// one.
struct MlpResult {
    MlpCase what;
    uint32_t rows = 0;
    double wall = 0;    // seconds
    double passes = 0;  // seconds, 0 where the device has no clock
    double seconds = 0; // of these the one that counts: the passes' where there is one
    double gflops = 0;
    double peakGflops = 0;
    double peakRatio = 0;
    double textbookRatio = 0;
    std::optional<double> onednnRatio;
    double onednnGflops = 0;
    double textbookGflops = 0;
    double difference =
        0; // evaluation: largest from the textbook's results, relative to the largest of these
    std::vector<Profiler::Row> times;
};

// Cases that do not fit the device are left out, and said so on stderr.
std::vector<MlpResult> runRounds(Device& device, const MlpGroup& group, uint32_t rounds, uint32_t threads);

const char* nameOf(NetworkForm form);
const char* nameOf(Precision precision);
std::string nameOf(const MlpShape& shape); // "64x5"

} // namespace irradia
