// The loop over bounces: from the rays of one queue to those of the other, and the light they meet.
#pragma once

#include "engine/graph/frame_graph.h"
#include "engine/path/path_tap.h"
#include "engine/path/wave_buffers.h"
#include "engine/scene/gpu_scene.h"

namespace irradia {

class Bounces {
public:
    Bounces(Device& device, const GpuScene& scene, const PathTracerOptions& options,
            const WaveBuffers& buffers, const Buffer& constants);

    // Takes the rays of number params.depth on: traces them unless their hits are known, adds the light that
    // they meet, and where they scatter lets a light sample and the next ray follow.
    void add(FrameGraph& graph, const gpu::WaveParams& params, bool areTraced, bool scatters,
             const PathTap* tap) const;

private:
    void begin(FrameGraph& graph, const gpu::WaveParams& params, bool areTraced) const;
    void intersect(FrameGraph& graph, const gpu::WaveParams& params) const;
    Pass handling(FrameGraph& graph, const Kernel& kernel, const gpu::WaveParams& params) const;
    void handleEscapedRays(FrameGraph& graph, const gpu::WaveParams& params, const PathTap* tap) const;
    void handleEmissiveHits(FrameGraph& graph, const gpu::WaveParams& params, const PathTap* tap) const;
    void scatter(FrameGraph& graph, const gpu::WaveParams& params, const PathTap* tap) const;
    void connect(FrameGraph& graph, const gpu::WaveParams& params, const PathTap* tap) const;

    const GpuScene& scene_;
    const WaveBuffers& buffers_;
    const Buffer& constants_;
    BufferRange traceArguments_, itemArguments_;
    Kernel begin_, intersectClosest_, handleEscapedRays_, handleEmissiveHits_, scatter_, intersectShadow_,
        addDirectLight_;
};

} // namespace irradia
