// A cache that says the same radiance everywhere, in the place of a network: what a path tracer asks and
// records can then be judged by what it must come to.
#pragma once

#include "nrc/renderer/cache_tap.h"
#include "tests/reference/cache.h"
#include <vector>

namespace irradia::test {

class OracleCache {
public:
    // For pictures of `options`, all of whose pixels are one wave; with one training path a tile, and after
    // these `surfacePaths` from the surfaces of the scene, seen from kSurfaceDistance.
    OracleCache(Device& device, const PathTracerOptions& options, float radiance, uint32_t tilesX = 0,
                uint32_t tilesY = 0, uint32_t surfacePaths = 0);
    static constexpr float kSurfaceDistance = 1.5f;

    gpu::CacheRule& rule() { return rule_; } // never ends paths at first
    FilmImage render(const GpuScene& scene, const Camera& camera, uint32_t frames);

    // Of the last frame: its training paths, gathered light being the targets; the targets at all recorded
    // vertices; the weights of all queries.
    std::vector<reference::TrainingPath> trainingPaths() const;
    std::vector<glm::vec3> targets() const;
    std::vector<glm::vec3> queryWeights() const;

private:
    uint32_t pathCount() const { return rule_.tilesX * rule_.tilesY + surfacePaths_; }
    void answer(WavefrontPathTracer& tracer);
    void propagate(FrameGraph& graph);

    Device& device_;
    PathTracerOptions options_;
    float radiance_;
    uint32_t surfacePaths_;
    uint64_t pathRows_;
    gpu::CacheRule rule_{};
    CacheTap tap_;
    Kernel resolveQueries_, propagateTraining_;
    Buffer queries_, queryWeights_, predictions_, counters_, state_;
    Buffer trainingPaths_, trainingVertices_, trainingQueries_, pathSums_;
};

} // namespace irradia::test
