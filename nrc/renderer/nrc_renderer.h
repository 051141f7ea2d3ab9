// Rendering with a radiance cache (Müller 2021): paths end early in the cache, which learns from a few of
// them while frames are rendered.
#pragma once

#include "engine/path/wavefront_path_tracer.h"
#include "nrc/cache/cache.h"
#include "nrc/renderer/nrc_config.h"
#include "nrc/renderer/renderer.h"
#include "nrc/samplers/surface_paths.h"
#include "nrc/samplers/tile_paths.h"
#include <optional>

namespace irradia {

struct NrcOptions {
    PathTracerOptions paths;
    NrcConfig config;
    uint64_t seed = 1;
    std::optional<CacheKind> cache; // instead of the network that `config` describes
};

class NrcRenderer : public Renderer {
public:
    // `bounds`: the box in which the cache is asked, normally sceneBox's.
    NrcRenderer(Device& device, const GpuScene& scene, const Bounds& bounds, const NrcOptions& options,
                Profiler* profiler = nullptr);

    // The buffers that the constructor allocates on a device of these limits, for Device::plan.
    static std::vector<Device::PlannedBuffer> planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                      const NrcOptions& options);

    void renderFrame(const Camera& camera, uint32_t index) override; // and learns from it
    void forgetFilm() override;
    FilmImage readFilm() const override { return tracer_.readFilm(); }
    RendererStatistics statistics() const override;
    std::map<std::string, std::string> attributes() const override;

    void setLearning(bool learns) { learns_ = learns; } // false: the cache stays as it is
    // true: the frames that follow are not looked at, and show the cache before it knows anything. Otherwise
    // paths go on as the path tracer's until it has learned.
    void setWarmingUp(bool warmsUp) override { isWarmingUp_ = warmsUp; }

    const WavefrontPathTracer& tracer() const { return tracer_; }
    Cache& cache() { return *cache_; }
    const CacheCounts& counts() const { return counts_; } // of the last frame
    const Adaptation& adaptation() const { return adaptation_; }
    // Frames of the film whose paths went on as the path tracer's, since the cache knew nothing.
    uint32_t framesWithoutCache() const { return framesWithoutCache_; }
    // Where paths end in the next frame, with all of its training paths.
    gpu::CacheRule rule() const;
    // Numbered in this order: one a tile of the picture, those through the camera and from the scene's
    // surfaces that are not seen.
    uint32_t trainingPaths() const { return tiles_.tiles() + tiles_.unseen() + surfaces_.count(); }

private:
    void learn();
    void chooseTrainingPaths();
    bool isShown() const;
    PathTap listen(const Wave& wave);

    NrcOptions options_;
    Bounds bounds_;
    WavefrontPathTracer tracer_;
    std::unique_ptr<Cache> cache_;
    CacheTap tap_;
    CacheCounts counts_;
    Adaptation adaptation_;
    bool hasSurfaces_;
    TilePaths tiles_;             // of this frame
    SurfacePaths surfaces_;       // likewise
    double recordsPerPath_ = 4.0; // of the last frame's training paths
    bool learns_ = true;
    bool isWarmingUp_ = false;
    uint32_t framesWithoutCache_ = 0;
};

} // namespace irradia
