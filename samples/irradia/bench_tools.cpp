#include "bench_tools.h"
#include "engine/image/image.h"
#include "samples/support/standard_streams.h"
#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

namespace irradia {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

uint32_t cpuThreads(const Device& device) {
    const uint32_t cores = std::max(1u, std::thread::hardware_concurrency());
    const char* text = std::getenv("LP_NUM_THREADS");
    const int asked = device.isCpu() && text ? std::atoi(text) : 0;
    return asked > 0 ? static_cast<uint32_t>(asked) : cores;
}

void writeJson(const std::string& file, const nlohmann::ordered_json& json) {
    const std::string text = json.dump(2) + "\n";
    if (file == "-")
        writeResult(text);
    else
        writeFileAtomically(file, std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

} // namespace irradia
