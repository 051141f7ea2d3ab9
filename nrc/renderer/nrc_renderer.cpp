#include "nrc/renderer/nrc_renderer.h"

#include "nrc/cache/neural_cache.h"
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace irradia {
namespace {

// Of a frame, whatever the size of the picture: more teach no more, and a binding holds them.
constexpr uint32_t kMostRecords = 1u << 20;

// Müller 2021 learns from 65,536 records a frame of 1920 x 1080 pixels.
uint32_t recordsPerFrame(const NrcOptions& options) {
    const double share = options.paths.pixels() / (1920.0 * 1080.0);
    const double scaled = std::round(options.config.recordsAt1080p * share);
    return std::max(static_cast<uint32_t>(std::min<double>(scaled, kMostRecords)), options.config.minRecords);
}

// Training paths are of a record each, at least.
TilePaths tilePaths(const NrcOptions& options) {
    return {options.paths.width, options.paths.height, recordsPerFrame(options)};
}

uint32_t mostSurfacePaths(const NrcOptions& options) {
    return static_cast<uint32_t>(std::lround(double(options.config.uniformShare) * recordsPerFrame(options)));
}

PathTracerOptions pathOptions(bool isCpu, const VkPhysicalDeviceLimits& limits, const NrcOptions& options) {
    const TilePaths tiles = tilePaths(options);
    PathTracerOptions paths = options.paths;
    paths.kernels = cachedVertexKernels();
    paths.unseenPaths = std::max(tiles.mostUnseen(), mostSurfacePaths(options));
    paths.waveSize = std::min(WaveBuffers::wantedWave(isCpu, options.paths),
                              tiles.mostPixelsOfWave(limits.maxStorageBufferRange));
    return paths;
}

CacheKind cacheKind(const NrcOptions& options) {
    if (options.cache) return *options.cache;
    const NrcConfig& config = options.config;
    NeuralCacheOptions cache;
    cache.model = config.model;
    cache.steps = config.steps;
    cache.factorise = config.factorise;
    cache.selfTraining = config.selfTraining;
    cache.shown = config.shown;
    cache.showReflectance = config.showReflectance;
    cache.seed = options.seed;
    return neuralCache(cache);
}

CacheRoom cacheRoom(const NrcOptions& options, uint32_t largestWave) {
    const uint32_t records = recordsPerFrame(options);
    return {largestWave, records + mostSurfacePaths(options), records};
}

} // namespace

NrcRenderer::NrcRenderer(Device& device, const GpuScene& scene, const Bounds& bounds,
                         const NrcOptions& options, Profiler* profiler)
    : options_(options)
    , bounds_(bounds)
    , tracer_(device, scene, pathOptions(device.isCpu(), device.limits(), options), profiler)
    , cache_(cacheKind(options).make(device, cacheRoom(options, tracer_.largestWave())))
    , tap_(device, cache_->buffers())
    , adaptation_(options.config.adaptation, options.config.steps, options.config.model.optimizer.emaDecay)
    , hasSurfaces_(scene.triangles > 0)
    , tiles_(tilePaths(options))
    , surfaces_(bounds, mostSurfacePaths(options)) {
    chooseTrainingPaths();
}

std::vector<Device::PlannedBuffer> NrcRenderer::planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                        const NrcOptions& options) {
    const PathTracerOptions paths = pathOptions(isCpu, limits, options);
    auto list = WavefrontPathTracer::planned(isCpu, paths);
    auto cache =
        cacheKind(options).planned(isCpu, limits, cacheRoom(options, WaveBuffers::largestWave(isCpu, paths)));
    list.insert(list.end(), std::move_iterator(cache.begin()), std::move_iterator(cache.end()));
    return list;
}

void NrcRenderer::renderFrame(const Camera& camera, uint32_t index) {
    FrameGraph& graph = tracer_.graph();
    tracer_.beginFrame(camera, index);
    cache_->begin(graph);
    if (!isShown()) ++framesWithoutCache_;
    for (Waves waves = tracer_.waves(); const auto wave = waves.next();) {
        const PathTap tap = listen(*wave);
        cache_->beginQueries(graph);
        tracer_.traceWave(*wave, &tap);
        graph.section("query");
        cache_->answer(graph, tracer_.radiance());
        graph.section("");
        tracer_.addToFilm(*wave);
    }
    if (learns_) learn();
    graph.execute();
    tracer_.endFrame();
    counts_ = cache_->counts();
    if (learns_ && counts_.records > 0) {
        adaptation_.observe(counts_.training.meanPrediction, counts_.training.meanTarget);
        const double records = double(counts_.records) + counts_.skippedRecords;
        recordsPerPath_ = std::max(records, 1.0) / trainingPaths();
    }
    chooseTrainingPaths();
}

// Paths that are not seen, and what all training paths of the frame teach.
void NrcRenderer::learn() {
    FrameGraph& graph = tracer_.graph();
    gpu::CacheRule unseen = rule();
    unseen.lastDepth = options_.config.suffixBounces;
    graph.section("train");
    tiles_.traceUnseen(tracer_, tap_, unseen, tiles_.tiles());
    surfaces_.trace(tracer_, tap_, unseen, tiles_.tiles() + tiles_.unseen());
    cache_->learn(graph, trainingPaths(), adaptation_.effort());
    graph.section("");
}

// As many as give the wanted number of records if they are as long as in the frame before.
void NrcRenderer::chooseTrainingPaths() {
    const double paths = recordsPerFrame(options_) / recordsPerPath_;
    const double surfaces = hasSurfaces_ ? std::round(options_.config.uniformShare * paths) : 0.0;
    tiles_.choose(paths - surfaces);
    surfaces_.choose(surfaces);
}

void NrcRenderer::forgetFilm() {
    framesWithoutCache_ = 0;
    tracer_.forgetFilm();
}

RendererStatistics NrcRenderer::statistics() const {
    return {tracer_.raysTraced(), counts_.records, counts_.training.loss, framesWithoutCache_};
}

std::map<std::string, std::string> NrcRenderer::attributes() const {
    auto attributes = cache_->attributes();
    attributes["trainingSteps"] = std::to_string(counts_.training.steps);
    return attributes;
}

PathTap NrcRenderer::listen(const Wave& wave) {
    gpu::CacheRule rule = this->rule();
    if (!learns_ || wave.firstSample > 0) rule.tilesX = rule.tilesY = 0;
    if (!isShown()) {
        rule.boxHigh.w = std::numeric_limits<float>::infinity();
        rule.endDepth = gpu::kNoDepth;
    }
    return tap_.listen(tracer_, rule, tiles_.touchedBy(wave));
}

// A cache that knows nothing is not shown (of light that no path has found there is nothing to know), unless
// it was asked for at a given vertex, or has its error made up for by paths that go on.
bool NrcRenderer::isShown() const {
    const NrcConfig& config = options_.config;
    const bool knows = adaptation_.hasLearned() && counts_.state.metLight != 0;
    return isWarmingUp_ || knows || config.endDepth != gpu::kNoDepth || config.spread < 0 ||
           config.residualShare > 0;
}

gpu::CacheRule NrcRenderer::rule() const {
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
    tiles_.setTiles(rule);
    rule.unbiasedShare = adaptation_.unbiasedShare(config.unbiasedShare);
    rule.residualShare = config.residualShare;
    rule.trainingSpread = config.trainingSpread;
    return rule;
}

} // namespace irradia
