// Where the rays of a wave's paths begin: at the camera, or (as rays whose hits are known) at the scene's
// surfaces.
#pragma once

#include "engine/graph/frame_graph.h"
#include "engine/path/wave_buffers.h"
#include "engine/scene/gpu_scene.h"

namespace irradia {

class CameraRays {
public:
    CameraRays(Device& device, const GpuScene& scene, const PathTracerOptions& options);
    // Into the first queue; the paths' radiance begins at 0.
    void generate(FrameGraph& graph, const WaveBuffers& buffers, const Buffer& constants,
                  const gpu::WaveParams& wave) const;

private:
    Kernel kernel_;
};

// Points uniform over the area of the scene's surfaces, which needs its area table, seen from `distance`
// away.
class SurfaceRays {
public:
    SurfaceRays(Device& device, const GpuScene& scene, const PathTracerOptions& options);
    // Into the first queue and the hits. Throws Error(Internal) where the scene has no area table.
    void generate(FrameGraph& graph, const WaveBuffers& buffers, const Buffer& constants,
                  const gpu::WaveParams& wave, float distance) const;

private:
    const GpuScene& scene_;
    Kernel kernel_;
};

} // namespace irradia
