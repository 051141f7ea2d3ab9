// The path tracer as a wavefront (Laine et al. 2013; the stages and names are those of pbrt-v4): queues of
// rays pass through kernels, one bounce at a time, and a film gathers frames.
#pragma once

#include "engine/graph/frame_graph.h"
#include "engine/path/film_image.h"
#include "engine/scene/gpu_scene.h"
#include "shared/path.h"

namespace irradia {

struct PathTracerOptions {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t maxBounces = 16;     // a path has at most maxBounces + 2 edges, light connection included
    uint32_t samplesPerFrame = 1; // samples of a pixel that make one frame
    uint32_t seed = 1;
    bool surfaces = false; // gather the AOV layers
    uint32_t waveSize = 0; // paths in flight; 0 = the device class's default. Changes no result.
};

class WavefrontPathTracer {
public:
    WavefrontPathTracer(Device& device, const GpuScene& scene, const PathTracerOptions& options,
                        Profiler* profiler = nullptr);

    // What the constructor will allocate, for Device::plan.
    static std::vector<Device::PlannedBuffer> plannedBuffers(const Device& device,
                                                             const PathTracerOptions& options);

    // Adds a frame to the film. `index` numbers it for the random numbers: frames are independent, and the
    // same index gives the same frame, whatever was rendered before.
    void renderFrame(const Camera& camera, uint32_t index);

    uint32_t frames() const { return frames_; } // in the film
    FilmImage readFilm() const;
    uint64_t raysTraced() const; // of all kinds, by the last frame

private:
    struct Kernels {
        Kernel generateCameraRays, beginBounce, intersectClosest, handleEscapedRays, handleEmissiveHits,
            recordSurfaces, scatter, intersectShadow, addDirectLight, updateFilm;
    };

    void traceWave(const Camera& camera, uint32_t firstPixel, uint32_t pathCount, uint32_t sampleIndex,
                   bool firstSample);
    void bounce(uint32_t depth, uint32_t firstPixel, uint32_t sampleIndex);
    void recordSurfaces(const Camera& camera, uint32_t firstPixel, uint32_t pathCount);

    Device& device_;
    const GpuScene& scene_;
    PathTracerOptions options_;
    FrameGraph graph_;
    Kernels kernels_;
    uint32_t waveSize_;
    uint32_t frames_ = 0;

    Buffer rays_[2]; // RayQueue: current and next
    Buffer hits_;
    Buffer shadowRays_;
    Buffer visibility_;
    Buffer radiance_; // vec4 per path: what its samples of this frame have gathered
    Buffer counters_;
    Buffer arguments_;
    Buffer film_;
    Buffer surfaces_;
};

} // namespace irradia
