// The path tracer as a wavefront (Laine et al. 2013; the stages and names are those of pbrt-v4): queues of
// rays pass through kernels, one bounce at a time, and a film gathers frames.
#pragma once

#include "engine/path/bounces.h"
#include "engine/path/film.h"
#include "engine/path/ray_source.h"

namespace irradia {

class WavefrontPathTracer {
public:
    WavefrontPathTracer(Device& device, const GpuScene& scene, const PathTracerOptions& options,
                        Profiler* profiler = nullptr);

    // What the constructor allocates, for Device::plan, in scenes that let light through; in others less.
    static std::vector<Device::PlannedBuffer> planned(bool isCpu, const PathTracerOptions& options);

    // Adds a frame to the film. `index` numbers it for the random numbers: frames are independent, and the
    // same index gives the same frame, whatever was rendered before.
    void renderFrame(const Camera& camera, uint32_t index);

    // The steps of a frame, for renderers that take more: begin, each wave's samples in turn, each followed
    // by what is added to radiance(), the wave's film, and at last the graph's execution and end.
    FrameGraph& graph() { return graph_; }
    void beginFrame(const Camera& camera, uint32_t index);
    Waves waves() const;
    void traceWave(const Wave& wave, const PathTap* tap = nullptr);
    void addToFilm(const Wave& wave) { film_.add(graph_, buffers_, wave); }
    // `paths` paths that no pixel sees, for a tap alone: through the camera's pixels, or from points uniform
    // over the scene's surfaces (whose area table is packed) as seen from `distance` away. A wave has at most
    // `most`.
    Waves unseenCameraWaves(uint32_t paths, uint32_t most) const;
    Waves surfaceWaves(uint32_t paths, uint32_t most) const;
    void traceSurfaceWave(const Wave& wave, float distance, const PathTap& tap);
    void endFrame() { film_.endFrame(); }
    void forgetFilm() { film_.forget(graph_); } // the next frame is the film's first

    const Buffer& radiance() const { return buffers_.radiance; } // vec4 per path of the wave
    const Buffer& pathStates() const {
        return buffers_.pathStates;
    } // a quad per path, where the tap has them
    uint32_t largestWave() const { return waveSize_; }
    // Number of the last ray of a path, which only meets emission.
    uint32_t deepestRay() const { return options_.maxBounces + 1; }

    uint32_t frames() const { return film_.frames(); } // in the film
    FilmImage readFilm() const { return film_.read(); }
    uint64_t raysTraced() const; // of all kinds, by the last frame

private:
    gpu::WaveParams paramsOf(const Wave& wave) const;
    void follow(const Wave& wave, gpu::WaveParams params, const PathTap* tap);

    Device& device_;
    const GpuScene& scene_;
    PathTracerOptions options_;
    FrameGraph graph_;
    uint32_t waveSize_;
    WaveBuffers buffers_;
    Buffer constants_; // FrameUniforms
    CameraRays cameraRays_;
    SurfaceRays surfaceRays_;
    Bounces bounces_;
    Film film_;
    uint32_t frame_ = 0; // that was begun, for the random numbers
};

} // namespace irradia
