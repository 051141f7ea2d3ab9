#include "nrc/renderer/picture_memory.h"

#include "engine/error.h"
#include <cmath>
#include <numeric>

namespace irradia {
namespace {

uint64_t pictureBytes(const Device& device, const NrcOptions& options, bool hasCache) {
    const auto buffers = pictureBuffers(device, options, hasCache);
    return std::accumulate(buffers.begin(), buffers.end(), uint64_t{0},
                           [](uint64_t sum, const auto& buffer) { return sum + buffer.bytes; });
}

NrcOptions scaled(NrcOptions options, double scale) {
    const auto edge = [&](uint32_t pixels) {
        return std::max(static_cast<uint32_t>(std::floor(pixels * scale)), 1u);
    };
    options.paths.width = edge(options.paths.width);
    options.paths.height = edge(options.paths.height);
    return options;
}

} // namespace

std::vector<Device::PlannedBuffer> pictureBuffers(const Device& device, const NrcOptions& options,
                                                  bool hasCache) {
    auto buffers = hasCache ? NrcRenderer::planned(device.isCpu(), device.limits(), options)
                            : WavefrontPathTracer::planned(device.isCpu(), options.paths);
    if (device.sharesMemory())
        buffers.push_back(
            {"picture read back", FilmImage::hostBytes(options.paths.pixels(), options.paths.layers), 1});
    return buffers;
}

void requireRoomForPicture(const Device& device, const NrcOptions& options, bool hasCache) {
    const uint64_t left = device.memoryBudget() - std::min(device.memoryUsed(), device.memoryBudget());
    const uint64_t bytes = pictureBytes(device, options, hasCache);
    if (bytes <= left) return;
    double fits = 0.0, tooLarge = 1.0;
    for (int i = 0; i < 20; ++i) {
        const double middle = 0.5 * (fits + tooLarge);
        (pictureBytes(device, scaled(options, middle), hasCache) <= left ? fits : tooLarge) = middle;
    }
    const PathTracerOptions largest = scaled(options, fits).paths;
    const bool someFit = pictureBytes(device, scaled(options, fits), hasCache) <= left;
    constexpr double kMebibyte = 1024.0 * 1024.0;
    fail(ExitCode::OutOfMemory, "a picture of {}x{} pixels takes {:.0f} MiB, and {} has {:.0f} MiB left; {}",
         options.paths.width, options.paths.height, static_cast<double>(bytes) / kMebibyte,
         device.description().name, static_cast<double>(left) / kMebibyte,
         someFit ? fmt::format("the largest of its shape that fits is {}x{}", largest.width, largest.height)
                 : "none is small enough");
}

} // namespace irradia
