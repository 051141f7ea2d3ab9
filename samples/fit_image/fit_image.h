// What a run of the program is asked for, and the run.
#pragma once

#include "engine/gpu/device.h"
#include <string>
#include <vector>

namespace irradia {

struct FitOptions {
    std::string picture;
    std::string network; // JSON file; empty = networks/hash_grid.json, which is built in
    uint32_t steps = 1000;
    double seconds = 0; // of learning, instead of a number of steps
    uint32_t batch = 1u << 14;
    uint32_t seed = 1;
    DeviceOptions device;
    std::string progress = "auto";

    std::string output; // the rest: files to write, empty = not
    std::string png;
    std::string csv;
    std::string chart;
    std::vector<std::string> against; // CSV files of other runs, for the chart
    std::string save;
    std::string json;
};

// Learns the picture and writes what is asked for.
void fitImage(const FitOptions& options);

} // namespace irradia
