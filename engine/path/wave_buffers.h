// The buffers of a wave of paths: one list of names and bytes, that the plan and the allocation are made
// from.
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/path/path_tracer_options.h"
#include "engine/path/wave.h"
#include <array>

namespace irradia {

struct WaveBuffers {
    // Allocates them.
    WaveBuffers(Device& device, const PathTracerOptions& options, bool isTransparent);

    // What the constructor allocates, in its order. `isTransparent`: surfaces of the scene let light through.
    static std::vector<Device::PlannedBuffer> planned(bool isCpu, const PathTracerOptions& options,
                                                      bool isTransparent = true);

    // Paths in flight that are wanted, and those that there are at most.
    static uint32_t wantedWave(bool isCpu, const PathTracerOptions& options);
    static uint32_t largestWave(bool isCpu, const PathTracerOptions& options);

    std::array<Buffer, 2> rays; // RayQueue: current and next
    Buffer hits, shadowRays, visibility;
    Buffer passages;   // a quad per path (shared/queue.h)
    Buffer pathStates; // a quad per path, a tap's
    Buffer radiance;   // vec4 per path
    Buffer counters, arguments;
};

} // namespace irradia
