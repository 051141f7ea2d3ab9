// The path tracer as a wavefront (Laine et al. 2013; the stages and names are those of pbrt-v4): queues of
// rays pass through kernels, one bounce at a time, and a film gathers frames.
#pragma once

#include "engine/graph/frame_graph.h"
#include "engine/path/cache_paths.h"
#include "engine/path/film_image.h"
#include "engine/path/path_buffers.h"
#include "engine/scene/gpu_scene.h"

namespace irradia {

class WavefrontPathTracer {
public:
    WavefrontPathTracer(Device& device, const GpuScene& scene, const PathTracerOptions& options,
                        Profiler* profiler = nullptr);

    // Adds a frame to the film. `index` numbers it for the random numbers: frames are independent, and the
    // same index gives the same frame, whatever was rendered before.
    void renderFrame(const Camera& camera, uint32_t index);

    // The steps of a frame, for renderers that take more: begin, each wave's samples in turn, each followed
    // by what the cache adds to radiance(), the wave's film, and at last the graph's execution and end.
    FrameGraph& graph() { return graph_; }
    void beginFrame();
    Waves waves() const;
    void traceWave(const Camera& camera, const Wave& wave, uint32_t frame, const CachePaths* cache = nullptr);
    void addToFilm(const Wave& wave);
    // `paths` paths that are not seen and only train: through the camera's pixels, or from points uniform over
    // the scene's surfaces (whose area table is packed) as seen from `distance` away.
    Waves trainingWaves(uint32_t paths) const;
    Waves surfaceWaves(uint32_t paths) const;
    void traceSurfaceWave(const Wave& wave, uint32_t frame, float distance, const CachePaths& cache);
    void endFrame();
    void forgetFilm();                                          // the next frame is the film's first
    const Buffer& radiance() const { return buffers_.radiance; } // vec4 per path of the wave
    uint32_t largestWave() const { return waveSize_; }
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
    // Of the wave's first path, for the random numbers.
    uint32_t sampleIndex(const Wave& wave, uint32_t frame) const {
        return frame * options_.samplesPerFrame + wave.firstSample;
    }
    uint32_t trainingWave() const; // paths at most, whose training vertices one binding holds

    Device& device_;
    const GpuScene& scene_;
    PathTracerOptions options_;
    FrameGraph graph_;
    Kernels kernels_;
    uint32_t waveSize_;
    uint32_t frames_ = 0;
    PathBuffers buffers_;
};

} // namespace irradia
