// Rendering with a neural radiance cache (Müller 2021): paths end early in the cache, which learns from a few
// of them while frames are rendered.
#pragma once

#include "nrc/cache/radiance_cache.h"
#include "nrc/learning/batch_rows.h"
#include "nrc/renderer/cache_tap.h"
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

    // The buffers that the constructor allocates on a device of these limits, for Device::plan.
    static std::vector<Device::PlannedBuffer> planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                      const NrcOptions& options);

    // Adds a frame to the film and learns from it. `index` numbers it for the random numbers.
    void renderFrame(const Camera& camera, uint32_t index);
    void forgetFilm(); // what follows is averaged anew; what was learned stays

    void setLearning(bool learns) { learns_ = learns; } // false: the cache stays as it is
    // true: the frames that follow are not looked at, and show the cache before it knows anything. Otherwise
    // paths go on as the path tracer's until it has learned.
    void setWarmingUp(bool warmsUp) { isWarmingUp_ = warmsUp; }

    const WavefrontPathTracer& tracer() const { return tracer_; }
    RadianceCache& cache() { return cache_; }
    const CacheCounts& counts() const { return counts_; } // of the last frame
    const Adaptation& adaptation() const { return adaptation_; }
    // Frames of the film whose paths went on as the path tracer's, since the cache knew nothing.
    uint32_t framesWithoutCache() const { return framesWithoutCache_; }

private:
    // Training paths of a frame, numbered in this order: one a tile of the picture, those through the camera
    // and from the scene's surfaces that are not seen.
    struct TrainingPaths {
        uint32_t tilesX = 0, tilesY = 0, camera = 0, surfaces = 0;
        uint32_t tiles() const { return tilesX * tilesY; }
        uint32_t count() const { return tiles() + camera + surfaces; }
    };

    void learn();
    TrainingPaths wantedPaths() const;
    RowRange tilesOf(const Wave& wave) const;
    bool isShown() const;
    gpu::CacheRule rule() const;
    CachePaths cachePaths(const Wave& wave) const;
    CachePaths unseenPaths(const Wave& wave, uint32_t firstTraining) const;
    CachePaths bound(gpu::CacheRule rule, const RowRange& training) const;

    NrcOptions options_;
    Bounds bounds_;
    WavefrontPathTracer tracer_;
    CacheTap tap_;
    uint32_t mostTraining_; // paths of a wave at most, whose vertices one binding holds
    RadianceCache cache_;
    CacheCounts counts_;
    Adaptation adaptation_;
    bool hasSurfaces_;
    double recordsPerPath_ = 4.0; // of the last frame's training paths
    TrainingPaths training_;      // of this frame
    bool learns_ = true;
    bool isWarmingUp_ = false;
    uint32_t framesWithoutCache_ = 0;
};

} // namespace irradia
