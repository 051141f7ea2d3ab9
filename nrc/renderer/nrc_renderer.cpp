#include "nrc/renderer/nrc_renderer.h"

#include <algorithm>
#include <cmath>

namespace irradia {
namespace {

PathTracerOptions cachedPaths(PathTracerOptions options) {
    options.cached = true;
    return options;
}

uint32_t pixelCount(const NrcOptions& options) {
    return options.paths.width * options.paths.height;
}

// Müller 2021 learns from 65,536 records a frame of 1920 x 1080 pixels.
uint32_t recordsPerFrame(const NrcOptions& options) {
    const double share = pixelCount(options) / (1920.0 * 1080.0);
    const auto scaled = static_cast<uint32_t>(std::lround(options.config.recordsAt1080p * share));
    return std::max(scaled, options.config.minRecords);
}

// At most, of a record each: that many tiles, and that many paths from surfaces.
uint32_t mostTiles(const NrcOptions& options) {
    return std::min(recordsPerFrame(options), pixelCount(options));
}

uint32_t mostSurfacePaths(const NrcOptions& options) {
    return static_cast<uint32_t>(std::lround(double(options.config.uniformShare) * recordsPerFrame(options)));
}

// How far away those are who see the surfaces: the mean chord of a convex body is 4 V / S (Cauchy).
float meanChord(const Bounds& box) {
    const glm::vec3 e = box.upper - box.lower;
    return 2.0f * e.x * e.y * e.z / std::max(e.x * e.y + e.y * e.z + e.z * e.x, 1e-30f);
}

CacheOptions cacheOptions(const NrcOptions& options, uint32_t largestWave) {
    CacheOptions cache;
    cache.model = options.config.model;
    cache.queries = largestWave;
    cache.records = recordsPerFrame(options);
    cache.trainingPaths = mostTiles(options) + mostSurfacePaths(options);
    cache.steps = options.config.steps;
    cache.factorise = options.config.factorise;
    cache.selfTraining = options.config.selfTraining;
    cache.seed = options.seed;
    return cache;
}

} // namespace

NrcRenderer::NrcRenderer(Device& device, const GpuScene& scene, const Bounds& bounds,
                         const NrcOptions& options, Profiler* profiler)
    : options_(options)
    , bounds_(bounds)
    , tracer_(device, scene, cachedPaths(options.paths), profiler)
    , cache_(device, cacheOptions(options, tracer_.largestWave()))
    , adaptation_(options.config.adaptation, options.config.steps, options.config.model.optimizer.emaDecay)
    , hasSurfaces_(scene.triangles > 0)
    , training_(wantedPaths()) {}

std::vector<Device::PlannedBuffer> NrcRenderer::plannedBuffers(const Device& device,
                                                               const NrcOptions& options) {
    auto planned = WavefrontPathTracer::plannedBuffers(device, cachedPaths(options.paths));
    const uint32_t wave = WavefrontPathTracer::largestWave(device, options.paths);
    for (auto& buffer : RadianceCache::plannedBuffers(cacheOptions(options, wave)))
        planned.push_back(std::move(buffer));
    return planned;
}

void NrcRenderer::renderFrame(const Camera& camera, uint32_t index) {
    FrameGraph& graph = tracer_.graph();
    tracer_.beginFrame();
    cache_.begin(graph);
    for (const Wave& wave : tracer_.waves()) {
        for (uint32_t sample = 0; sample < options_.paths.samplesPerFrame; ++sample) {
            const CachePaths paths = cachePaths(learns_ && sample == 0);
            cache_.beginQueries(graph);
            tracer_.traceWave(camera, wave, index, sample, &paths);
            graph.section("query");
            cache_.answer(graph, tracer_.radiance(), options_.config.shown, options_.config.showReflectance);
            graph.section("");
        }
        tracer_.addToFilm(wave);
    }
    if (learns_) {
        graph.section("train");
        for (const Wave& wave : tracer_.surfaceWaves(training_.surfaces))
            tracer_.traceSurfaceWave(wave, index, meanChord(bounds_), surfacePaths());
        cache_.learn(graph, training_.count(), adaptation_.effort());
        graph.section("");
    }
    graph.execute();
    tracer_.endFrame();
    counts_ = cache_.counts();
    if (learns_ && counts_.records > 0) {
        adaptation_.observe(counts_.training.meanPrediction, counts_.training.meanTarget);
        const double records = double(counts_.records) + counts_.skippedRecords;
        recordsPerPath_ = std::max(records, 1.0) / training_.count();
    }
    training_ = wantedPaths();
}

void NrcRenderer::forgetFilm() {
    tracer_.forgetFilm();
}

// As many as give the wanted number of records if they are as long as in the frame before; tiles as square as
// the picture allows.
NrcRenderer::TrainingPaths NrcRenderer::wantedPaths() const {
    const double width = options_.paths.width, height = options_.paths.height;
    const double most = mostTiles(options_);
    const double paths = recordsPerFrame(options_) / recordsPerPath_;
    const double surfaces = hasSurfaces_ ? std::round(options_.config.uniformShare * paths) : 0.0;
    const double tiles = std::clamp(paths - surfaces, 1.0, most);
    const double x = std::clamp(std::floor(std::sqrt(tiles * width / height)), 1.0, std::min(width, most));
    const double y = std::clamp(std::floor(tiles / x), 1.0, std::min(height, std::floor(most / x)));
    return {static_cast<uint32_t>(x), static_cast<uint32_t>(y),
            std::min(static_cast<uint32_t>(surfaces), mostSurfacePaths(options_))};
}

// All of such a path is suffix.
CachePaths NrcRenderer::surfacePaths() const {
    CachePaths paths = cachePaths(true);
    paths.rule.lastDepth = options_.config.suffixBounces;
    return paths;
}

CachePaths NrcRenderer::cachePaths(bool train) const {
    const NrcConfig& config = options_.config;
    const glm::vec3 extent = bounds_.upper - bounds_.lower;
    const float longest = std::max({extent.x, extent.y, extent.z, 1e-30f});
    gpu::CacheRule rule{};
    // Vertices are computed from barycentrics: those of the box's own faces may lie outside by rounding.
    const glm::vec3 slack(1e-4f * longest);
    rule.boxLow = glm::vec4(bounds_.lower - slack, 1.0f / (longest * 1.0002f));
    rule.boxHigh = glm::vec4(bounds_.upper + slack, config.spread);
    rule.endDepth = config.endDepth;
    rule.deepest = tracer_.deepestRay();
    rule.lastDepth = rule.deepest + config.suffixBounces;
    rule.tilesX = train ? training_.tilesX : 0;
    rule.tilesY = train ? training_.tilesY : 0;
    rule.width = options_.paths.width;
    rule.height = options_.paths.height;
    rule.unbiasedShare = adaptation_.unbiasedShare(config.unbiasedShare);
    rule.residualShare = config.residualShare;
    rule.trainingSpread = config.trainingSpread;
    return {cache_.queries(),
            cache_.queryWeights(),
            cache_.counters(),
            cache_.trainingPaths(),
            cache_.trainingVertices(),
            cache_.trainingQueries(),
            rule};
}

} // namespace irradia
