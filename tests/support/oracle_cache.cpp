#include "tests/support/oracle_cache.h"

#include "tests/support/cache_buffers.h"
#include <bit>

namespace irradia::test {
namespace {

constexpr uint32_t kRecordsPerPath = 4; // which a renderer expects as long as none are counted

PathRecordsOptions recordsOptions(const CacheRoom& room) {
    PathRecordsOptions options;
    options.trainingPaths = room.trainingPaths;
    return options;
}

uint32_t answeredRows(const CacheRoom& room) {
    return paddedRows(std::max(room.queries, PathRecords::pathsTogether(recordsOptions(room))));
}

} // namespace

OracleCache::OracleCache(Device& device, const CacheRoom& room, float radiance)
    : radiance_(radiance)
    , scale_(device)
    , queries_(device, room.queries)
    , records_(device, recordsOptions(room), queries_.counters(), scale_.state())
    , predictions_(device, "predictions", uint64_t{answeredRows(room)} * 16) {
    gpu::CacheState state = scale_.read();
    state.frames = 1; // it has learned
    scale_.set(state);
}

CacheBuffers OracleCache::buffers() const {
    return {queries_.inputs(), queries_.weights(),  queries_.counters(),
            records_.paths(),  records_.vertices(), records_.queries()};
}

void OracleCache::answer(FrameGraph& graph, BufferRange radiance) {
    graph.fill(predictions_, std::bit_cast<uint32_t>(radiance_));
    queries_.resolve(graph, predictions_, scale_.state(), false, radiance);
}

void OracleCache::learn(FrameGraph& graph, uint32_t paths, const TrainingEffort& /*effort*/) {
    graph.fill(predictions_, std::bit_cast<uint32_t>(radiance_));
    records_.propagate(graph, paths, [this](FrameGraph&, const RowCount&, BufferRange) -> BufferRange {
        return predictions_;
    });
}

CacheKind oracle(float radiance) {
    return {[](bool, const VkPhysicalDeviceLimits&, const CacheRoom& room) {
                auto list = CacheQueries::planned(room.queries);
                for (auto& buffer : PathRecords::planned(recordsOptions(room))) list.push_back(buffer);
                list.push_back({"predictions", uint64_t{answeredRows(room)} * 16});
                return list;
            },
            [radiance](Device& device, const CacheRoom& room) {
                return std::make_unique<OracleCache>(device, room, radiance);
            }};
}

NrcOptions oracleOptions(const PathTracerOptions& paths, float radiance, uint32_t trainingPaths,
                         bool fromSurfaces) {
    NrcOptions options;
    options.paths = paths;
    options.cache = oracle(radiance);
    options.config.spread = options.config.trainingSpread = std::numeric_limits<float>::infinity();
    options.config.unbiasedShare = 0.0f;
    options.config.adaptation.on = false;
    options.config.recordsAt1080p = 0;
    options.config.minRecords = kRecordsPerPath * trainingPaths;
    options.config.uniformShare = fromSurfaces ? 1.0f : 0.0f;
    return options;
}

OracleRenderer::OracleRenderer(Device& device, const GpuScene& scene, const Bounds& bounds,
                               const NrcOptions& options)
    : device_(device)
    , renderer_(device, scene, bounds, options)
    , buffers_(renderer_.cache().buffers()) {
    renderer_.setWarmingUp(true); // it is asked from the first frame on
}

FilmImage OracleRenderer::render(const Camera& camera, uint32_t frames) {
    renderer_.forgetFilm();
    for (uint32_t frame = 0; frame < frames; ++frame) renderer_.renderFrame(camera, frame);
    return renderer_.readFilm();
}

std::vector<reference::TrainingPath> OracleRenderer::trainingPaths() const {
    const uint32_t count = renderer_.trainingPaths();
    const auto quads = [&](const BufferRange& range, uint64_t bytes) {
        return download<glm::uvec4>(device_, *range.buffer, paddedRows(count) * bytes / sizeof(glm::uvec4));
    };
    return unpackPaths({quads(buffers_.trainingPaths, gpu::kTrainingPathBytes),
                        quads(buffers_.trainingVertices, gpu::kVertexBytes),
                        quads(buffers_.trainingQueries, gpu::kCacheInputBytes)},
                       count);
}

std::vector<glm::vec3> OracleRenderer::targets() const {
    std::vector<glm::vec3> targets;
    for (const reference::TrainingPath& path : trainingPaths())
        for (const reference::TrainingVertex& v : path.vertices) targets.emplace_back(v.gathered);
    return targets;
}

std::vector<glm::vec3> OracleRenderer::queryWeights() const {
    const auto counters = download<uint32_t>(device_, *buffers_.counters.buffer, gpu::kCacheCounters);
    std::vector<glm::vec3> weights;
    for (const glm::uvec4& quad :
         download<glm::uvec4>(device_, *buffers_.queryWeights.buffer, counters[gpu::kQueryCounter]))
        weights.emplace_back(std::bit_cast<glm::vec4>(quad));
    return weights;
}

} // namespace irradia::test
