#include "tests/support/oracle_cache.h"

#include "kernels/cache.h"
#include "shared/network.h"
#include "tests/support/cache_buffers.h"
#include <bit>
#include <limits>

namespace irradia::test {
namespace {

constexpr uint64_t kInputBytes = gpu::kCacheInputQuads * 16;

uint64_t padded(uint64_t rows) {
    return (std::max<uint64_t>(rows, 1) + gpu::kRowPadding - 1) / gpu::kRowPadding * gpu::kRowPadding;
}

PathTracerOptions asked(PathTracerOptions options) {
    options.kernels = cachedVertexKernels();
    options.waveSize = options.width * options.height;
    return options;
}

} // namespace

OracleCache::OracleCache(Device& device, const PathTracerOptions& options, float radiance, uint32_t tilesX,
                         uint32_t tilesY, uint32_t surfacePaths)
    : device_(device)
    , options_(asked(options))
    , radiance_(radiance)
    , surfacePaths_(surfacePaths)
    , pathRows_(padded(tilesX * tilesY + surfacePaths))
    , tap_(device)
    , resolveQueries_(device, kernels::resolve_queries)
    , propagateTraining_(device, kernels::propagate_training)
    , queries_(device, "queries", padded(options_.waveSize) * kInputBytes)
    , queryWeights_(device, "query weights", padded(options_.waveSize) * 16)
    , predictions_(device, "predictions", padded(options_.waveSize) * 16)
    , counters_(device, "counters", gpu::kCacheCounters * 4)
    , state_(makeBuffer(device, "state",
                        std::vector{gpu::CacheState{1.0f, 1.0f, 1, 0, 0, 0, 0, 0}})) // has learned
    , trainingPaths_(device, "training paths", pathRows_ * gpu::kTrainingPathVectors * 16)
    , trainingVertices_(device, "training vertices",
                        pathRows_ * gpu::kMaxTrainingVertices * gpu::kTrainingVertexVectors * 16)
    , trainingQueries_(device, "training queries", pathRows_ * kInputBytes)
    , pathSums_(device, "path sums", pathRows_ * 16) {
    constexpr float kNever = std::numeric_limits<float>::infinity();
    rule_.boxLow = glm::vec4(-1e6f, -1e6f, -1e6f, 1.0f);
    rule_.boxHigh = glm::vec4(1e6f, 1e6f, 1e6f, kNever);
    rule_.endDepth = gpu::kNoDepth;
    rule_.deepest = options_.maxBounces + 1;
    rule_.lastDepth = rule_.deepest + 8;
    rule_.tilesX = tilesX;
    rule_.tilesY = tilesY;
    rule_.trainingSpread = kNever;
}

FilmImage OracleCache::render(const GpuScene& scene, const Camera& camera, uint32_t frames) {
    WavefrontPathTracer tracer(device_, scene, options_);
    for (uint32_t frame = 0; frame < frames; ++frame) {
        const CachePaths paths{queries_,          queryWeights_,    counters_, trainingPaths_,
                               trainingVertices_, trainingQueries_, rule_};
        tracer.beginFrame(camera, frame);
        tracer.graph().fill(counters_, 0);
        tracer.graph().fill(trainingPaths_, 0);
        for (Waves waves = tracer.waves(); const auto wave = waves.next();) {
            const PathTap tap = tap_.listen(tracer, paths);
            tracer.traceWave(*wave, &tap);
            answer(tracer);
            tracer.addToFilm(*wave);
        }
        CachePaths fromSurfaces = paths;
        fromSurfaces.rule.waveTraining = rule_.tilesX * rule_.tilesY;
        for (Waves waves = tracer.surfaceWaves(surfacePaths_, UINT32_MAX); const auto wave = waves.next();) {
            const PathTap tap = tap_.listen(tracer, fromSurfaces);
            tracer.traceSurfaceWave(*wave, kSurfaceDistance, tap);
            fromSurfaces.rule.waveTraining += wave->paths();
        }
        propagate(tracer.graph());
        tracer.graph().execute();
        tracer.endFrame();
    }
    return tracer.readFilm();
}

void OracleCache::answer(WavefrontPathTracer& tracer) {
    tracer.graph().fill(predictions_, std::bit_cast<uint32_t>(radiance_));
    tracer.graph()
        .pass(resolveQueries_)
        .readWrite(counters_)
        .read(queries_)
        .read(queryWeights_)
        .read(predictions_)
        .read(state_)
        .readWrite(tracer.radiance())
        .push(gpu::ResolveParams{0})
        .dispatch(options_.waveSize);
}

void OracleCache::propagate(FrameGraph& graph) {
    graph.pass(propagateTraining_)
        .readWrite(counters_)
        .read(trainingPaths_)
        .readWrite(trainingVertices_)
        .read(trainingQueries_)
        .read(predictions_)
        .read(state_)
        .write(pathSums_)
        .push(gpu::RecordsParams{pathCount(), 0, 0, 0.0f})
        .dispatch(pathCount());
}

std::vector<reference::TrainingPath> OracleCache::trainingPaths() const {
    const auto all = [&](const Buffer& buffer) {
        return download<glm::uvec4>(device_, buffer, buffer.bytes() / sizeof(glm::uvec4));
    };
    return unpackPaths({all(trainingPaths_), all(trainingVertices_), all(trainingQueries_)}, pathCount());
}

std::vector<glm::vec3> OracleCache::targets() const {
    std::vector<glm::vec3> targets;
    for (const reference::TrainingPath& path : trainingPaths())
        for (const reference::TrainingVertex& v : path.vertices) targets.emplace_back(v.gathered);
    return targets;
}

std::vector<glm::vec3> OracleCache::queryWeights() const {
    const uint32_t count = download<uint32_t>(device_, counters_, 1).front();
    std::vector<glm::vec3> weights;
    for (const glm::uvec4& record : download<glm::uvec4>(device_, queryWeights_, count))
        weights.emplace_back(std::bit_cast<glm::vec4>(record));
    return weights;
}

} // namespace irradia::test
