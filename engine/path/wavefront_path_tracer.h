// The path tracer as a wavefront (Laine et al. 2013; the stages and names are those of pbrt-v4): queues of
// rays pass through kernels, one bounce at a time, and a film gathers frames.
#pragma once

#include "engine/graph/frame_graph.h"
#include "engine/path/cache_paths.h"
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
    bool surfaces = false;             // gather the AOV layers
    uint32_t waveSize = 0;             // paths in flight; 0 = the device class's default. Changes no result.
    bool cached = false;               // traceWave is given CachePaths
    uint32_t view = gpu::kViewPicture; // what the film shows; all else needs a cache
};

// Consecutive pixels whose paths are in flight together; path i belongs to pixel firstPixel + i. From
// gpu::kFirstSurfacePath on they are no pixels: their paths start at the scene's surfaces.
struct Wave {
    uint32_t firstPixel = 0;
    uint32_t paths = 0;
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

    // The steps of a frame, for renderers that take more: begin, each wave's samples in turn, each followed
    // by what the cache adds to radiance(), the wave's film, and at last the graph's execution and end.
    FrameGraph& graph() { return graph_; }
    void beginFrame();
    std::vector<Wave> waves() const;
    void traceWave(const Camera& camera, const Wave& wave, uint32_t frame, uint32_t sample,
                   const CachePaths* cache = nullptr);
    void addToFilm(const Wave& wave);
    // Paths from points uniform over the scene's surfaces (whose area table is packed), as seen from
    // `distance` away: they only train, with the numbers after those of the tiles' paths.
    std::vector<Wave> surfaceWaves(uint32_t paths) const;
    void traceSurfaceWave(const Wave& wave, uint32_t frame, float distance, const CachePaths& cache);
    void endFrame();
    void forgetFilm();                                   // the next frame is the film's first
    const Buffer& radiance() const { return radiance_; } // vec4 per path of the wave
    uint32_t largestWave() const { return waveSize_; }
    static uint32_t largestWave(const Device& device, const PathTracerOptions& options);
    // Number of the last ray of a path, which only meets emission.
    uint32_t deepestRay() const { return options_.maxBounces + 1; }

    uint32_t frames() const { return frames_; } // in the film
    FilmImage readFilm() const;
    uint64_t raysTraced() const; // of all kinds, by the last frame

private:
    struct Kernels {
        Kernel generateCameraRays, generateSurfaceRays, beginBounce, intersectClosest, handleEscapedRays,
            handleEmissiveHits, recordSurfaces, scatter, intersectShadow, addDirectLight, updateFilm;
    };

    void bounce(uint32_t depth, const Wave& wave, uint32_t sampleIndex, const CachePaths* cache);
    void beginBounce(uint32_t parity, bool areTraced);
    void meetSurfaces(const gpu::BounceParams& params, const CachePaths* cache);
    void scatter(const gpu::BounceParams& params, const CachePaths* cache);
    void addDirectLight(const CachePaths* cache);
    void recordSurfaces(const Camera& camera, const Wave& wave);

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
    Buffer pathStates_; // where there is a cache
    Buffer radiance_;   // vec4 per path: what its samples of this frame have gathered
    Buffer counters_;
    Buffer arguments_;
    Buffer film_;
    Buffer surfaces_;
};

} // namespace irradia
