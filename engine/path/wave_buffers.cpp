#include "engine/path/wave_buffers.h"

#include "shared/queue.h"

namespace irradia {
namespace {

// Paths in flight: on a CPU few enough for the queues to stay in its caches, on a GPU enough to fill it.
constexpr uint32_t kCpuWave = 1u << 15;
constexpr uint32_t kGpuWave = 1u << 20;

constexpr uint64_t kUnused = 16; // of a buffer that is bound and never accessed

} // namespace

uint32_t WaveBuffers::wantedWave(bool isCpu, const PathTracerOptions& options) {
    return options.waveSize != 0 ? options.waveSize : (isCpu ? kCpuWave : kGpuWave);
}

uint32_t WaveBuffers::largestWave(bool isCpu, const PathTracerOptions& options) {
    const uint32_t wanted = wantedWave(isCpu, options);
    return std::max({Waves::pathsOfWave(options.pixels(), options.samplesPerFrame, wanted),
                     std::min(options.unseenPaths, wanted), Waves::kPixelAlignment});
}

std::vector<Device::PlannedBuffer> WaveBuffers::planned(bool isCpu, const PathTracerOptions& options,
                                                        bool isTransparent) {
    const uint64_t wave = largestWave(isCpu, options);
    return {{"ray queue", wave * gpu::kRayQuads * 16},
            {"next ray queue", wave * gpu::kRayQuads * 16},
            {"hits", wave * 16},
            {"shadow ray queue", wave * gpu::kShadowRayQuads * 16},
            {"visibility", wave * (isTransparent ? 16 : 4)},
            {"passages", isTransparent ? wave * 16 : kUnused},
            {"path states", options.kernels.keepsPathStates ? wave * 16 : kUnused},
            {"path radiance", wave * 16},
            {"queue counters", gpu::kCounters * 4},
            {"dispatch arguments", gpu::kDispatchArguments * 4}};
}

WaveBuffers::WaveBuffers(Device& device, const PathTracerOptions& options, bool isTransparent) {
    const auto plan = planned(device.isCpu(), options, isTransparent);
    auto next = plan.begin();
    for (Buffer* buffer : {&rays[0], &rays[1], &hits, &shadowRays, &visibility, &passages, &pathStates,
                           &radiance, &counters, &arguments}) {
        *buffer = Buffer(device, next->name, next->bytes);
        ++next;
    }
}

} // namespace irradia
