#include "nrc/learning/encoding.h"

#include "engine/error.h"
#include "kernels/learning.h"
#include "nrc/learning/encoding_kernels.h"
#include "nrc/learning/random.h"

namespace irradia {
namespace {

constexpr float kInitialFeature = 1e-4f;

struct Grid {
    Buffer table;   // of levels
    Buffer entries; // of a sparse grid
    Kernel accumulate;
    uint32_t levels = 0;
    uint32_t encodeGroups = 0; // of levels: shaders/learning/grid.glsl
};

struct SlicePass {
    const char* name = nullptr;
    Kernel encode;
    std::unique_ptr<Grid> grid; // of a slice that is a grid
};

const char* passName(EncodingType type) {
    switch (type) {
    case EncodingType::Identity:
        return kernels::encode_identity.name;
    case EncodingType::Frequency:
    case EncodingType::TriangleWave:
        return kernels::encode_frequency.name;
    case EncodingType::OneBlob:
        return kernels::encode_one_blob.name;
    case EncodingType::SphericalHarmonics:
        return kernels::encode_spherical_harmonics.name;
    default:
        return kernels::encode_grid.name;
    }
}

std::unique_ptr<Grid> makeGrid(Device& device, const FeatureGrid& made, const EncodingSlice& slice) {
    auto grid = std::make_unique<Grid>();
    std::vector<gpu::GridLevel> table = made.levels;
    table.resize(gpu::kMaxGridLevels);
    grid->table = makeBuffer(device, "grid levels", table);
    grid->entries = makeBuffer(device, "grid entries", made.entries);
    grid->levels = slice.config.levels;
    grid->encodeGroups = slice.quads() / ((slice.config.featuresPerLevel + 3) / 4);
    return grid;
}

} // namespace

struct Encoding::State {
    EncodingLayout layout;
    uint64_t features = 0;
    std::optional<uint32_t> storedCorners;
    std::vector<SlicePass> slices;
};

Encoding::Encoding(Device& device, const std::vector<EncodingConfig>& parts, uint32_t inputs,
                   Precision precision, std::span<const glm::vec3> touched)
    : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.layout = layOut(parts, inputs);
    const FeatureGrids grids = layOutGrids(s.layout, device.limits(), touched);
    s.features = grids.features;
    s.storedCorners = grids.storedCorners;
    auto grid = grids.grids.begin();
    for (const EncodingSlice& slice : s.layout.slices) {
        SlicePass pass{passName(slice.config.type), {}, nullptr};
        if (isGrid(slice.config.type)) {
            pass.encode = makeEncodeGridKernel(device, s.layout, slice, *grid, precision);
            pass.grid = makeGrid(device, *grid, slice);
            pass.grid->accumulate =
                makeAccumulateKernel(device, s.layout, slice, *grid, s.features, precision);
            ++grid;
        } else {
            pass.encode = makeEncodeKernel(device, s.layout, slice, precision);
        }
        s.slices.push_back(std::move(pass));
    }
}

Encoding::~Encoding() = default;
Encoding::Encoding(Encoding&&) noexcept = default;

uint32_t Encoding::inputs() const {
    return state_->layout.inputs;
}
uint32_t Encoding::inputQuads() const {
    return state_->layout.inputQuads();
}
uint32_t Encoding::width() const {
    return state_->layout.encodedQuads * 4;
}
uint64_t Encoding::featureCount() const {
    return state_->features;
}
std::optional<uint32_t> Encoding::storedCorners() const {
    return state_->storedCorners;
}
uint64_t Encoding::sumBytes() const {
    return state_->features * 8;
}

void Encoding::initialise(std::span<float> features, uint64_t seed) const {
    if (features.size() != featureCount())
        fail(ExitCode::Internal, "encoding: {} features to initialise, not {}", features.size(),
             featureCount());
    RandomStream random(seed);
    for (float& feature : features) feature = kInitialFeature * (2.0f * random.uniform() - 1.0f);
}

void Encoding::encode(FrameGraph& graph, const RowCount& rows, BufferRange inputs, BufferRange features,
                      BufferRange encoded) const {
    for (const SlicePass& slice : state_->slices) {
        Pass pass = graph.pass(slice.encode, slice.name);
        pass.read(rows.counters).read(inputs);
        if (slice.grid)
            pass.read(slice.grid->table)
                .read({*features.buffer, features.offset, featureCount() * 4})
                .read(slice.grid->entries);
        pass.write(encoded)
            .push(gpu::RowsParams{rows.index, rows.capacity, rows.first, 0, {}})
            .dispatch(uint64_t(rows.capacity) * (slice.grid ? slice.grid->encodeGroups : 1));
    }
}

void Encoding::accumulateGradient(FrameGraph& graph, const RowCount& rows, BufferRange inputs,
                                  BufferRange encodedGradient, BufferRange sums) const {
    for (const SlicePass& slice : state_->slices) {
        if (!slice.grid) continue;
        graph.pass(slice.grid->accumulate, kernels::accumulate_grid_gradient.name)
            .read(rows.counters)
            .read(inputs)
            .read(slice.grid->table)
            .read(slice.grid->entries)
            .read(encodedGradient)
            .readWrite({*sums.buffer, sums.offset, sumBytes()})
            .push(gpu::RowsParams{rows.index, rows.capacity, rows.first, 0, {}})
            .dispatch(uint64_t(rows.capacity) * slice.grid->levels);
    }
}

} // namespace irradia
