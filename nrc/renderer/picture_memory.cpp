#include "nrc/renderer/picture_memory.h"

#include "engine/error.h"
#include "engine/path/film_image.h"
#include <cmath>
#include <numeric>

namespace irradia {
namespace {

std::vector<Device::PlannedBuffer> buffersOf(const Device& device, const MethodSetup& setup,
                                             const PathTracerOptions& paths) {
    auto buffers = setup.planned(device.isCpu(), device.limits(), paths);
    if (device.sharesMemory())
        buffers.push_back({"picture read back", FilmImage::hostBytes(paths.pixels(), paths.layers), 1});
    return buffers;
}

uint64_t pictureBytes(const Device& device, const MethodSetup& setup, const PathTracerOptions& paths) {
    const auto buffers = buffersOf(device, setup, paths);
    return std::accumulate(buffers.begin(), buffers.end(), uint64_t{0},
                           [](uint64_t sum, const auto& buffer) { return sum + buffer.bytes; });
}

PathTracerOptions scaled(PathTracerOptions paths, double scale) {
    const auto edge = [&](uint32_t pixels) {
        return std::max(static_cast<uint32_t>(std::floor(pixels * scale)), 1u);
    };
    paths.width = edge(paths.width);
    paths.height = edge(paths.height);
    return paths;
}

} // namespace

std::vector<Device::PlannedBuffer> pictureBuffers(const Device& device, const MethodSetup& setup) {
    return buffersOf(device, setup, setup.paths());
}

void requireRoomForPicture(const Device& device, const MethodSetup& setup) {
    const PathTracerOptions& paths = setup.paths();
    const uint64_t left = device.memoryBudget() - std::min(device.memoryUsed(), device.memoryBudget());
    const uint64_t bytes = pictureBytes(device, setup, paths);
    if (bytes <= left) return;
    double fits = 0.0, tooLarge = 1.0;
    for (int i = 0; i < 20; ++i) {
        const double middle = 0.5 * (fits + tooLarge);
        (pictureBytes(device, setup, scaled(paths, middle)) <= left ? fits : tooLarge) = middle;
    }
    const PathTracerOptions largest = scaled(paths, fits);
    const bool someFit = pictureBytes(device, setup, largest) <= left;
    constexpr double kMebibyte = 1024.0 * 1024.0;
    fail(ExitCode::OutOfMemory, "a picture of {}x{} pixels takes {:.0f} MiB, and {} has {:.0f} MiB left; {}",
         paths.width, paths.height, static_cast<double>(bytes) / kMebibyte, device.description().name,
         static_cast<double>(left) / kMebibyte,
         someFit ? fmt::format("the largest of its shape that fits is {}x{}", largest.width, largest.height)
                 : "none is small enough");
}

} // namespace irradia
