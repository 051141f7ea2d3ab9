// A cache that says the same radiance everywhere, in the place of a network: what a path tracer asks and
// records can then be judged by what it must come to.
#pragma once

#include "nrc/cache/cache_queries.h"
#include "nrc/cache/radiance_scale.h"
#include "nrc/cache/training_records.h"
#include "nrc/renderer/nrc_renderer.h"
#include "tests/reference/cache.h"
#include <limits>

namespace irradia::test {

class OracleCache : public Cache {
public:
    OracleCache(Device& device, const CacheRoom& room, float radiance);

    CacheBuffers buffers() const override;
    void begin(FrameGraph& graph) override { records_.begin(graph); }
    void beginQueries(FrameGraph& graph) override { queries_.begin(graph); }
    void answer(FrameGraph& graph, BufferRange radiance) override;
    // Light goes back along the paths; nothing is learned from it.
    void learn(FrameGraph& graph, uint32_t paths, const TrainingEffort& effort) override;
    CacheCounts counts() const override { return {}; }

private:
    float radiance_;
    RadianceScale scale_;
    CacheQueries queries_;
    PathRecords records_;
    Buffer predictions_;
};

CacheKind oracle(float radiance);

// For pictures of `paths` by an oracle: paths never end in it at first, and none trains themselves unless
// told so. `trainingPaths`: how many a frame has, through the camera or, with `fromSurfaces`, all but one
// from the scene's surfaces.
NrcOptions oracleOptions(const PathTracerOptions& paths, float radiance, uint32_t trainingPaths = 1,
                         bool fromSurfaces = false);

// The renderer of the product, with an oracle.
class OracleRenderer {
public:
    OracleRenderer(Device& device, const GpuScene& scene, const Bounds& bounds, const NrcOptions& options);

    FilmImage render(const Camera& camera, uint32_t frames); // anew, of frames 0 to `frames` - 1
    gpu::CacheRule rule() const { return renderer_.rule(); }

    // Of the last frame: its training paths, gathered light being the targets; the targets at all recorded
    // vertices; the weights of all queries of the last wave.
    std::vector<reference::TrainingPath> trainingPaths() const;
    std::vector<glm::vec3> targets() const;
    std::vector<glm::vec3> queryWeights() const;

private:
    Device& device_;
    NrcRenderer renderer_;
    CacheBuffers buffers_;
};

} // namespace irradia::test
