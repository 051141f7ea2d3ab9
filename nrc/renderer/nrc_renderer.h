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
    // `bounds`: the box in which the cache is asked, normally sceneBox's.
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
    // Training paths of a frame: one a tile of the picture, and those that start at the scene's surfaces.
    struct TrainingPaths {
        uint32_t tilesX = 0, tilesY = 0, surfaces = 0;
        uint32_t count() const { return tilesX * tilesY + surfaces; }
    };

    CachePaths cachePaths(bool train) const;
    CachePaths surfacePaths() const;
    TrainingPaths wantedPaths() const;

    NrcOptions options_;
    Bounds bounds_;
    WavefrontPathTracer tracer_;
    RadianceCache cache_;
    CacheCounts counts_;
    Adaptation adaptation_;
    bool hasSurfaces_;
    double recordsPerPath_ = 4.0; // of the last frame's training paths
    TrainingPaths training_;      // of this frame
    bool learns_ = true;
};

} // namespace irradia
