#include "nrc/renderer/nrc_renderer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace irradia {
namespace {

constexpr uint64_t kPathBytes = gpu::kTrainingPathBytes, kVertexBytes = gpu::kVertexBytes; // of products

// Of a frame, whatever the size of the picture: more teach no more, and a binding holds them.
constexpr uint32_t kMostRecords = 1u << 20;

// Müller 2021 learns from 65,536 records a frame of 1920 x 1080 pixels.
uint32_t recordsPerFrame(const NrcOptions& options) {
    const double share = options.paths.pixels() / (1920.0 * 1080.0);
    const double scaled = std::round(options.config.recordsAt1080p * share);
    return std::max(static_cast<uint32_t>(std::min<double>(scaled, kMostRecords)), options.config.minRecords);
}

// At most, of a record each: that many tiles, camera paths (those of tiles with them), and paths from
// surfaces.
uint32_t mostTiles(const NrcOptions& options) {
    return std::min(recordsPerFrame(options), options.paths.pixels());
}

uint32_t mostCameraPaths(const NrcOptions& options) {
    return recordsPerFrame(options);
}

uint32_t mostSurfacePaths(const NrcOptions& options) {
    return static_cast<uint32_t>(std::lround(double(options.config.uniformShare) * recordsPerFrame(options)));
}

// Pixels of a wave at most, so that one binding holds the vertices of all tiles that it touches: of its own
// pixels' share and, with those that lie in it by a part, of four rows of tiles.
uint32_t mostPixelsOfWave(const NrcOptions& options, uint64_t bindingBytes) {
    const uint64_t bound = bindingBytes / kVertexBytes - gpu::kTileRows;
    const uint64_t tiles = mostTiles(options), rows = 4 * std::min<uint64_t>(options.paths.width, tiles);
    return static_cast<uint32_t>(
        std::min<uint64_t>((bound - rows) * options.paths.pixels() / tiles, UINT32_MAX));
}

PathTracerOptions pathOptions(bool isCpu, const VkPhysicalDeviceLimits& limits, const NrcOptions& options) {
    PathTracerOptions paths = options.paths;
    paths.kernels = cachedVertexKernels();
    paths.unseenPaths = std::max(mostCameraPaths(options) - mostTiles(options), mostSurfacePaths(options));
    paths.waveSize = std::min(WaveBuffers::wantedWave(isCpu, options.paths),
                              mostPixelsOfWave(options, limits.maxStorageBufferRange));
    return paths;
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
    cache.trainingPaths = mostCameraPaths(options) + mostSurfacePaths(options);
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
    , tracer_(device, scene, pathOptions(device.isCpu(), device.limits(), options), profiler)
    , tap_(device)
    // The range that is bound begins at a whole tile of rows.
    , mostTraining_(device.limits().maxStorageBufferRange / gpu::kVertexBytes - gpu::kTileRows)
    , cache_(device, cacheOptions(options, tracer_.largestWave()))
    , adaptation_(options.config.adaptation, options.config.steps, options.config.model.optimizer.emaDecay)
    , hasSurfaces_(scene.triangles > 0)
    , training_(wantedPaths()) {}

std::vector<Device::PlannedBuffer> NrcRenderer::planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                        const NrcOptions& options) {
    const PathTracerOptions paths = pathOptions(isCpu, limits, options);
    auto list = WavefrontPathTracer::planned(isCpu, paths);
    auto cache =
        RadianceCache::planned(isCpu, limits, cacheOptions(options, WaveBuffers::largestWave(isCpu, paths)));
    list.insert(list.end(), std::move_iterator(cache.begin()), std::move_iterator(cache.end()));
    return list;
}

void NrcRenderer::renderFrame(const Camera& camera, uint32_t index) {
    FrameGraph& graph = tracer_.graph();
    tracer_.beginFrame(camera, index);
    cache_.begin(graph);
    if (!isShown()) ++framesWithoutCache_;
    for (Waves waves = tracer_.waves(); const auto wave = waves.next();) {
        const PathTap tap = tap_.listen(tracer_, cachePaths(*wave));
        cache_.beginQueries(graph);
        tracer_.traceWave(*wave, &tap);
        graph.section("query");
        cache_.answer(graph, tracer_.radiance(), options_.config.shown, options_.config.showReflectance);
        graph.section("");
        tracer_.addToFilm(*wave);
    }
    if (learns_) learn();
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

// Paths that are not seen, and what all training paths of the frame teach.
void NrcRenderer::learn() {
    FrameGraph& graph = tracer_.graph();
    graph.section("train");
    uint32_t first = training_.tiles();
    for (Waves waves = tracer_.unseenCameraWaves(training_.camera, mostTraining_);
         const auto wave = waves.next();) {
        const PathTap tap = tap_.listen(tracer_, unseenPaths(*wave, first));
        tracer_.traceWave(*wave, &tap);
        first += wave->paths();
    }
    for (Waves waves = tracer_.surfaceWaves(training_.surfaces, mostTraining_);
         const auto wave = waves.next();) {
        const PathTap tap = tap_.listen(tracer_, unseenPaths(*wave, first));
        tracer_.traceSurfaceWave(*wave, meanChord(bounds_), tap);
        first += wave->paths();
    }
    cache_.learn(graph, training_.count(), adaptation_.effort());
    graph.section("");
}

void NrcRenderer::forgetFilm() {
    framesWithoutCache_ = 0;
    tracer_.forgetFilm();
}

// As many as give the wanted number of records if they are as long as in the frame before; tiles as square as
// the picture allows. Where that is more than a path a pixel, the others are not seen.
NrcRenderer::TrainingPaths NrcRenderer::wantedPaths() const {
    const double width = options_.paths.width, height = options_.paths.height;
    const double most = mostTiles(options_);
    const double paths = recordsPerFrame(options_) / recordsPerPath_;
    const double surfaces = hasSurfaces_ ? std::round(options_.config.uniformShare * paths) : 0.0;
    const double camera = std::clamp(paths - surfaces, 1.0, double(mostCameraPaths(options_)));
    const double tiles = std::min(camera, most);
    const double x = std::clamp(std::floor(std::sqrt(tiles * width / height)), 1.0, std::min(width, most));
    const double y = std::clamp(std::floor(tiles / x), 1.0, std::min(height, std::floor(most / x)));
    const double unseen = camera > width * height ? camera - x * y : 0.0;
    return {static_cast<uint32_t>(x), static_cast<uint32_t>(y), static_cast<uint32_t>(unseen),
            std::min(static_cast<uint32_t>(surfaces), mostSurfacePaths(options_))};
}

// The tiles that a wave's pixels touch, whole rows of them.
RowRange NrcRenderer::tilesOf(const Wave& wave) const {
    const auto tileRow = [&](uint32_t pixel) {
        return pixel / options_.paths.width * training_.tilesY / options_.paths.height;
    };
    const uint32_t first = tileRow(wave.firstPixel), last = tileRow(wave.firstPixel + wave.pixels - 1);
    return {first * training_.tilesX, (last + 1 - first) * training_.tilesX};
}

CachePaths NrcRenderer::cachePaths(const Wave& wave) const {
    gpu::CacheRule rule = this->rule();
    if (!learns_ || wave.firstSample > 0) rule.tilesX = rule.tilesY = 0;
    if (!isShown()) {
        rule.boxHigh.w = std::numeric_limits<float>::infinity();
        rule.endDepth = gpu::kNoDepth;
    }
    return bound(rule, tilesOf(wave));
}

// All of such a path is suffix.
CachePaths NrcRenderer::unseenPaths(const Wave& wave, uint32_t firstTraining) const {
    gpu::CacheRule rule = this->rule();
    rule.lastDepth = options_.config.suffixBounces;
    rule.waveTraining = firstTraining;
    return bound(rule, {firstTraining, wave.paths()});
}

// With the ranges of these training paths.
CachePaths NrcRenderer::bound(gpu::CacheRule rule, const RowRange& training) const {
    rule.firstTraining = training.first / gpu::kTileRows * gpu::kTileRows;
    const uint64_t paths = training.first + training.rows - rule.firstTraining;
    return {cache_.queries(),
            cache_.queryWeights(),
            cache_.counters(),
            {cache_.trainingPaths(), rule.firstTraining * kPathBytes, paths * kPathBytes},
            {cache_.trainingVertices(), rule.firstTraining * kVertexBytes, paths * kVertexBytes},
            cache_.trainingQueries(),
            rule};
}

// A cache that knows nothing is not shown (of light that no path has found there is nothing to know), unless
// it was asked for at a given vertex, or has its error made up for by paths that go on.
bool NrcRenderer::isShown() const {
    const NrcConfig& config = options_.config;
    const bool knows = adaptation_.hasLearned() && counts_.state.metLight != 0;
    return isWarmingUp_ || knows || config.endDepth != gpu::kNoDepth || config.spread < 0 ||
           config.residualShare > 0;
}

// Where paths end, with all of the frame's training paths.
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
    rule.tilesX = training_.tilesX;
    rule.tilesY = training_.tilesY;
    rule.unbiasedShare = adaptation_.unbiasedShare(config.unbiasedShare);
    rule.residualShare = config.residualShare;
    rule.trainingSpread = config.trainingSpread;
    return rule;
}

} // namespace irradia
