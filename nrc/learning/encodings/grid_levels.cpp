#include "nrc/learning/encodings/grid_levels.h"

#include "engine/error.h"
#include "nrc/learning/encodings/sparse_corners.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace irradia {
namespace {

constexpr uint64_t kEntryAlignment = 8;        // whole quads of any number of features
constexpr uint32_t kMaxSparseResolution = 129; // of a level whose corners are listed

uint64_t alignedEntries(uint64_t entries) {
    return (entries + kEntryAlignment - 1) / kEntryAlignment * kEntryAlignment;
}

uint64_t power(uint64_t base, uint32_t exponent) {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

void checkConfig(const GridConfig& config, std::span<const glm::vec3> touched) {
    if (config.levels < 1 || config.levels > gpu::kMaxGridLevels)
        fail(ExitCode::BadData, "encoding: a grid has 1 to {} levels, not {}", gpu::kMaxGridLevels,
             config.levels);
    if (!std::has_single_bit(config.featuresPerLevel) || config.featuresPerLevel > 16)
        fail(ExitCode::BadData, "encoding: a grid has 1, 2, 4, 8 or 16 features a level, not {}",
             config.featuresPerLevel);
    if (config.kind == gpu::kGridSparse && touched.empty())
        fail(ExitCode::BadData,
             "encoding: a SparseGrid needs the points whose voxels it stores, there are 0");
}

// Müller et al. 2022, section 3: the cells an edge at level l, less one.
double scaleOf(const GridConfig& config, uint32_t level) {
    return config.baseResolution * std::pow(config.perLevelScale, level) - 1.0;
}

gpu::GridLevel hashLevel(const GridConfig& config, float scale, uint32_t resolution) {
    const uint64_t table = uint64_t{1} << config.log2HashmapSize;
    const uint64_t corners = power(resolution, config.dims);
    if (corners > table) return {scale, 0, 0, static_cast<uint32_t>(table)};
    return {scale, resolution, 0, static_cast<uint32_t>(alignedEntries(corners))};
}

gpu::GridLevel denseLevel(const GridConfig& config, float scale, uint32_t resolution) {
    const uint64_t corners = alignedEntries(power(resolution + 1, config.dims));
    return {scale, resolution + 1, 0, static_cast<uint32_t>(std::min<uint64_t>(corners, UINT32_MAX))};
}

// Lists the corners of the voxels that hold a point; the level's `size` becomes their number.
void addSparseLevel(FeatureGrid& grid, gpu::GridLevel level, const GridConfig& config,
                    const FeatureRoom& room) {
    level.first = static_cast<uint32_t>(grid.entries.size());
    const uint64_t listed = grid.entries.size() + level.size;
    const uint64_t most =
        std::min<uint64_t>(room.limits.maxStorageBufferRange / 4, room.limits.maxTexelBufferElements);
    if (listed > most)
        fail(ExitCode::OutOfMemory,
             "encoding: a SparseGrid up to level {} lists {} corners, a binding holds {}", grid.levels.size(),
             listed, most);
    const std::vector<uint32_t> corners = touchedCorners(level, config.dims, room.touched);
    grid.entries.resize(listed, gpu::kAbsentEntry);
    for (size_t i = 0; i < corners.size(); ++i)
        grid.entries[level.first + corners[i]] = static_cast<uint32_t>(grid.end + i);
    level.size = static_cast<uint32_t>(alignedEntries(corners.size()));
    grid.levels.push_back(level);
    grid.end += level.size;
}

// Throws Error(OutOfMemory) where so many features, each with 8 bytes of gradient sums, outgrow a binding.
void requireBindable(uint64_t features, const std::string& what, const VkPhysicalDeviceLimits& limits) {
    const uint64_t bytes = features * 8;
    if (bytes > limits.maxStorageBufferRange)
        fail(ExitCode::OutOfMemory,
             "encoding: {} makes {} features, whose gradients are {:.1f} MiB of sums; a binding holds {:.1f} "
             "MiB",
             what, features, static_cast<double>(bytes) / 1048576.0,
             static_cast<double>(limits.maxStorageBufferRange) / 1048576.0);
}

} // namespace

FeatureGrid makeFeatureGrid(const GridConfig& config, const FeatureRoom& room) {
    checkConfig(config, room.touched);
    FeatureGrid grid;
    grid.end = room.first / config.featuresPerLevel;
    for (uint32_t l = 0; l < config.levels; ++l) {
        const double scale = scaleOf(config, l);
        const auto resolution = static_cast<uint32_t>(std::ceil(scale)) + 1;
        const auto narrowed = static_cast<float>(scale);
        const std::string what = fmt::format("a grid up to level {} of {} cells an edge", l, resolution);
        if (config.kind == gpu::kGridSparse) {
            if (resolution > kMaxSparseResolution)
                fail(ExitCode::BadData,
                     "encoding: level {} of a SparseGrid has {} cells an edge, at most {} are allowed", l,
                     resolution, kMaxSparseResolution);
            addSparseLevel(grid, denseLevel(config, narrowed, resolution), config, room);
        } else {
            gpu::GridLevel level = config.kind == gpu::kGridHash ? hashLevel(config, narrowed, resolution)
                                                                 : denseLevel(config, narrowed, resolution);
            requireBindable((grid.end + level.size) * config.featuresPerLevel, what, room.limits);
            level.first = static_cast<uint32_t>(grid.end);
            grid.levels.push_back(level);
            grid.end += level.size;
        }
        requireBindable(grid.end * config.featuresPerLevel, what, room.limits);
    }
    return grid;
}

} // namespace irradia
