// The buffers of a wavefront path tracer: one list of names and bytes, that the plan and the allocation are
// made from.
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/path/path_tracer_options.h"
#include "engine/path/wave.h"
#include <array>

namespace irradia {

struct PathBuffers {
    // Allocates them.
    PathBuffers(Device& device, const PathTracerOptions& options);

    // Sizes of what the constructor allocates, in its order; the film's parts and the layers' at the end.
    static std::vector<Device::PlannedBuffer> planned(bool isCpu, const PathTracerOptions& options);

    // Paths in flight that are wanted, and those that there are at most.
    static uint32_t wantedWave(bool isCpu, const PathTracerOptions& options);
    static uint32_t largestWave(bool isCpu, const PathTracerOptions& options);
    static uint32_t runOf(bool isCpu, const PathTracerOptions& options); // pixels of a wave at most

    std::array<Buffer, 2> rays; // RayQueue: current and next
    Buffer hits, shadowRays, visibility;
    Buffer pathStates; // where there is a cache
    Buffer radiance;   // vec4 per path of the wave
    Buffer sampleSums; // vec4 per pixel of the wave: of the frame's samples in waves before
    Buffer counters, arguments;
    // Per pixel of the picture, in parts that devices allocate at once: whole runs of a wave's pixels.
    std::vector<Buffer> film, surfaces;
    uint32_t pixelsOfPart = 0;

    // What `vectors` vec4 a pixel of a part's run are bound by.
    BufferRange ofPixels(const std::vector<Buffer>& parts, uint32_t vectors, uint32_t first,
                         uint32_t pixels) const {
        const uint64_t bytes = uint64_t{vectors} * 16;
        return {parts[first / pixelsOfPart], first % pixelsOfPart * bytes, pixels * bytes};
    }
};

} // namespace irradia
