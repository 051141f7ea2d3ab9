#include "samples/yardsticks/device_peak.h"
#include "engine/graph/frame_graph.h"
#include "kernels/textbook.h"
#include "samples/yardsticks/textbook/device_peak.h"
#include <chrono>

namespace irradia {

double measureDevicePeak(Device& device, double seconds) {
    constexpr uint32_t kInvocations = 1u << 16; // fills any device
    constexpr int kRuns = 3;
    const Kernel kernel(device, kernels::multiply_adds);
    const Buffer results(device, "peak results", kInvocations * sizeof(uint32_t));
    FrameGraph graph(device);
    const auto timed = [&](uint32_t iterations) {
        graph.pass(kernel)
            .write(results)
            .push(gpu::DevicePeakParams{iterations, 0.999f, 0.001f})
            .dispatch(kInvocations);
        const auto start = std::chrono::steady_clock::now();
        graph.execute();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const auto flops = [](uint32_t iterations) {
        return 2.0 * 4 * gpu::kPeakSums * gpu::kPeakUnroll * kInvocations * iterations;
    };

    uint32_t iterations = 16;
    timed(iterations); // compiles
    while (iterations < 1u << 20 && timed(iterations) < 0.5 * seconds) iterations *= 2;
    double best = 0;
    for (int i = 0; i < kRuns; ++i) best = std::max(best, flops(iterations) / timed(iterations));
    return best * 1e-9;
}

} // namespace irradia
