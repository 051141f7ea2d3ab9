// Rendering with a neural radiance cache (Müller 2021): paths end early in the cache, which learns from a few
// of them while frames are rendered.
#pragma once

#include "engine/path/wavefront_path_tracer.h"
#include "nrc/radiance_cache.h"
#include "nrc/renderer/nrc_config.h"

namespace irradia {

struct NrcOptions {
    PathTracerOptions paths;
    NrcConfig config;
    uint64_t seed = 1;
};

class NrcRenderer {
public:
    // `bounds`: the box in which the cache is asked, normally the scene's.
    NrcRenderer(Device& device, const GpuScene& scene, const Bounds& bounds, const NrcOptions& options,
                Profiler* profiler = nullptr);

    static std::vector<Device::PlannedBuffer> plannedBuffers(const Device& device, const NrcOptions& options);

    // Adds a frame to the film and learns from it. `index` numbers it for the random numbers.
    void renderFrame(const Camera& camera, uint32_t index);
    void forgetFilm(); // what follows is averaged anew; what was learned stays

    void setLearning(bool learns) { learns_ = learns; } // false: the cache stays as it is

    const WavefrontPathTracer& tracer() const { return tracer_; }
    RadianceCache& cache() { return cache_; }
    const CacheCounts& counts() const { return counts_; } // of the last frame
    const Adaptation& adaptation() const { return adaptation_; }

private:
    struct Tiles {
        uint32_t x = 0, y = 0;
        uint32_t count() const { return x * y; }
    };

    CachePaths cachePaths(bool train) const;
    CachePaths surfacePaths() const;
    Tiles wantedTiles() const;
    uint32_t trainingPaths() const { return tiles_.count() + surfacePaths_; } // of this frame

    NrcOptions options_;
    Bounds bounds_;
    WavefrontPathTracer tracer_;
    RadianceCache cache_;
    CacheCounts counts_;
    Adaptation adaptation_;
    double recordsPerPath_ = 2.0; // of the last frame's paths from the camera
    Tiles tiles_;                 // of this frame: one training path each
    uint32_t surfacePaths_;       // of a frame: training paths that start at the scene's surfaces
    bool learns_ = true;
};

} // namespace irradia
