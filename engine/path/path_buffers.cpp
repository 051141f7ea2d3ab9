#include "engine/path/path_buffers.h"

#include "shared/queue.h"

namespace irradia {
namespace {

// Paths in flight: on a CPU few enough for the queues to stay in its caches, on a GPU enough to fill it.
constexpr uint32_t kCpuWave = 1u << 15;
constexpr uint32_t kGpuWave = 1u << 20;

constexpr uint32_t kMostPixels =
    1u << 24; // of a part of the film: 0.75 GiB of layers, where devices allocate 1 GiB at least
constexpr uint64_t kUnused = 16; // of a buffer that is bound and never accessed

// Pixels of a part: whole runs.
uint32_t pixelsOf(uint32_t run) {
    return std::max(kMostPixels / run, 1u) * run;
}

} // namespace

uint32_t PathBuffers::wantedWave(bool isCpu, const PathTracerOptions& options) {
    return options.waveSize != 0 ? options.waveSize : (isCpu ? kCpuWave : kGpuWave);
}

uint32_t PathBuffers::largestWave(bool isCpu, const PathTracerOptions& options) {
    const uint32_t wanted = wantedWave(isCpu, options);
    return std::max({Waves::pathsOfWave(options.pixels(), options.samplesPerFrame, wanted),
                     std::min(options.trainingPaths, wanted), Waves::kPixelAlignment});
}

uint32_t PathBuffers::runOf(bool isCpu, const PathTracerOptions& options) {
    return Waves::pixelsOfWave(options.pixels(), largestWave(isCpu, options));
}

std::vector<Device::PlannedBuffer> PathBuffers::planned(bool isCpu, const PathTracerOptions& options) {
    const uint64_t wave = largestWave(isCpu, options);
    const uint32_t run = runOf(isCpu, options), part = pixelsOf(run);
    std::vector<Device::PlannedBuffer> list{{"ray queue", wave * gpu::kRayRecords * 16},
                                            {"next ray queue", wave * gpu::kRayRecords * 16},
                                            {"hits", wave * 16},
                                            {"shadow ray queue", wave * gpu::kShadowRayRecords * 16},
                                            {"visibility", wave * 4},
                                            {"path states", options.cached ? wave * 16 : kUnused},
                                            {"path radiance", wave * 16},
                                            {"sample sums", uint64_t{run} * 16},
                                            {"queue counters", gpu::kCounters * 4},
                                            {"dispatch arguments", gpu::kDispatchArguments * 4}};
    const auto addParts = [&](const char* name, uint64_t bytes) {
        for (uint64_t first = 0; first < options.pixels(); first += part)
            list.push_back({name, std::min<uint64_t>(part, options.pixels() - first) * bytes, run * bytes});
    };
    addParts("film", gpu::kFilmVectors * 16);
    if (options.surfaces) addParts("surfaces", gpu::kSurfaceVectors * 16);
    return list;
}

PathBuffers::PathBuffers(Device& device, const PathTracerOptions& options)
    : pixelsOfPart(pixelsOf(runOf(device.isCpu(), options))) {
    const auto plan = planned(device.isCpu(), options);
    auto next = plan.begin();
    for (Buffer* buffer : {&rays[0], &rays[1], &hits, &shadowRays, &visibility, &pathStates, &radiance,
                           &sampleSums, &counters, &arguments}) {
        *buffer = Buffer(device, next->name, next->bytes);
        ++next;
    }
    for (; next != plan.end(); ++next)
        (next->name == "film" ? film : surfaces).emplace_back(device, next->name, next->bytes);
}

} // namespace irradia
