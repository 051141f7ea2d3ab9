// Grids of features that are learned, in levels of growing resolution: dense; sparse, which stores only
// voxels that given points touch (NGLOD, Takikawa 2021); hashed (Müller 2022).
#include "engine/error.h"
#include "kernels/learning.h"
#include "nrc/learning/checksum.h"
#include "nrc/learning/encodings/grid_levels.h"
#include "nrc/learning/encodings/kind.h"
#include <cmath>

namespace irradia {
namespace {

constexpr double kFinestResolution =
    1 << 20; // a coordinate in single precision still tells 16 places in a cell

bool isMean(const EncodingConfig& config) {
    return config.whole("aggregation") == 1;
}

GridConfig gridConfig(const EncodingConfig& config, uint32_t kind) {
    return {.kind = kind,
            .dims = config.dims,
            .levels = config.whole("n_levels"),
            .featuresPerLevel = config.whole("n_features_per_level"),
            .log2HashmapSize = kind == gpu::kGridHash ? config.whole("log2_hashmap_size") : 0,
            .baseResolution = config.whole("base_resolution"),
            .perLevelScale = config.number("per_level_scale")};
}

class GridPasses : public SlicePasses {
public:
    GridPasses(const SliceContext& context, const FeatureGrid& grid, std::vector<uint32_t> constants)
        : features_(context.features)
        , levels_(static_cast<uint32_t>(grid.levels.size()))
        , encodeGroups_(context.slice.quads() /
                        ((context.slice.config.whole("n_features_per_level") + 3) / 4))
        , entries_(makeBuffer(context.device, "grid entries", grid.entries))
        , encode_(makeSliceKernel(context, kernels::encode_grid, kernels::encode_grid_half, constants)) {
        std::vector<gpu::GridLevel> table = grid.levels;
        table.resize(gpu::kMaxGridLevels);
        table_ = makeBuffer(context.device, "grid levels", table);
        constants.push_back(static_cast<uint32_t>(features_)); // where the sums' high words begin
        accumulate_ = makeSliceKernel(context, kernels::accumulate_grid_gradient,
                                      kernels::accumulate_grid_gradient_half, constants);
    }

    void encode(FrameGraph& graph, const RowCount& rows, BufferRange inputs, BufferRange features,
                BufferRange encoded) const override {
        graph.pass(encode_, kernels::encode_grid.name)
            .read(rows.counters)
            .read(inputs)
            .read(table_)
            .read({*features.buffer, features.offset, features_ * 4})
            .read(entries_)
            .write(encoded)
            .push(rowsParams(rows))
            .dispatch(uint64_t(rows.capacity) * encodeGroups_);
    }

    void accumulateGradient(FrameGraph& graph, const RowCount& rows, BufferRange inputs,
                            BufferRange encodedGradient, BufferRange sums) const override {
        graph.pass(accumulate_, kernels::accumulate_grid_gradient.name)
            .read(rows.counters)
            .read(inputs)
            .read(table_)
            .read(entries_)
            .read(encodedGradient)
            .readWrite({*sums.buffer, sums.offset, features_ * 8})
            .push(rowsParams(rows))
            .dispatch(uint64_t(rows.capacity) * levels_);
    }

private:
    uint64_t features_; // of all grids
    uint32_t levels_;
    uint32_t encodeGroups_; // of levels: shaders/learning/grid.glsl
    Buffer table_;          // of levels
    Buffer entries_;        // of a sparse grid
    Kernel encode_, accumulate_;
};

class GridFeatures : public SliceFeatures {
public:
    GridFeatures(const GridConfig& config, const FeatureRoom& room)
        : config_(config)
        , grid_(makeFeatureGrid(config, room)) {}

    uint64_t end() const override { return grid_.end * config_.featuresPerLevel; }

    std::optional<uint32_t> checksumBehind(uint32_t before) const override {
        if (config_.kind != gpu::kGridSparse) return {};
        return checksum<uint32_t>(grid_.entries, before);
    }

    std::unique_ptr<SlicePasses> makePasses(const SliceContext& context) const override {
        return std::make_unique<GridPasses>(context, grid_,
                                            std::vector<uint32_t>{config_.kind, config_.levels,
                                                                  config_.featuresPerLevel,
                                                                  isMean(context.slice.config)});
    }

private:
    GridConfig config_;
    FeatureGrid grid_;
};

void checkFinest(const JsonFields& fields, const EncodingConfig& config) {
    const double finest = config.whole("base_resolution") *
                          std::pow(config.number("per_level_scale"), config.whole("n_levels") - 1);
    if (finest > kFinestResolution)
        fail(ExitCode::BadData,
             "{}: {}, n_levels and per_level_scale make a finest level of {:.4g} cells an edge, at most {} "
             "are allowed",
             fields.file(), fields.pathOf("base_resolution"), finest, kFinestResolution);
}

std::string misfit(const EncodingConfig& config) {
    if (config.dims == 2 || config.dims == 3) return {};
    return fmt::format("a grid takes 2 or 3 inputs, not {}", config.dims);
}

template <uint32_t kind>
EncodingKind grid(const char* otype) {
    std::vector<EncodingKey> keys{
        wholeKey("n_levels", 1, 16, 8),
        wholeKey("n_features_per_level", {1, 2, 4, 8, 16}, 2),
        wholeKey("base_resolution", 1, 1u << 16, 16), // cells an edge
        numberKey("per_level_scale", {1, 16}, 2.0),
        choiceKey("aggregation", {"Concatenation", "Mean"}), // of the levels' values
    };
    if (kind == gpu::kGridHash) // entries a level at most
        keys.insert(keys.begin() + 2, wholeKey("log2_hashmap_size", 4, 24, 15));
    return {.otype = otype,
            .keys = std::move(keys),
            .checkKeys = checkFinest,
            .values =
                [](const EncodingConfig& config) {
                    return config.whole("n_features_per_level") *
                           (isMean(config) ? 1 : config.whole("n_levels"));
                },
            .misfit = misfit,
            .features = [](const EncodingConfig& config,
                           const FeatureRoom& room) -> std::unique_ptr<SliceFeatures> {
                return std::make_unique<GridFeatures>(gridConfig(config, kind), room);
            }};
}

} // namespace

EncodingKind denseGrid() {
    return grid<gpu::kGridDense>("DenseGrid");
}
EncodingKind sparseGrid() {
    return grid<gpu::kGridSparse>("SparseGrid");
}
EncodingKind hashGrid() {
    return grid<gpu::kGridHash>("HashGrid");
}

} // namespace irradia
