// Encodings of network inputs, composed over slices of the input: identity, frequency (Mildenhall 2020),
// triangle wave and one-blob (Müller 2019, 2021), spherical harmonics, and grids of trainable features:
// dense, sparse (only voxels that given points touch, as in NGLOD, Takikawa 2021), hashed (Müller 2022).
//
// Each part's values begin at a multiple of four; gaps, and the padding to a multiple of kFeaturePadding,
// hold ones, which act as bias of the first layer.
#pragma once

#include "engine/graph/frame_graph.h"
#include "nrc/config.h"
#include <glm/glm.hpp>
#include <memory>
#include <span>

namespace irradia {

// A batch of rows on the device: how many there are is word `index` of `counters`, at most `capacity`.
struct RowCount {
    BufferRange counters;
    uint32_t index = 0;
    uint32_t capacity = 0; // a multiple of gpu::kRowPadding
};

class Encoding {
public:
    // `inputs` values a row, from which the parts take theirs in order. `touched`: points of the unit cube (a
    // point a row) whose voxels a SparseGrid stores; it is refused without any. Throws Error(BadData) where
    // parts and inputs do not fit, Error(OutOfMemory) with the numbers where a level outgrows a binding.
    Encoding(Device& device, const std::vector<EncodingConfig>& parts, uint32_t inputs, Precision precision,
             std::span<const glm::vec3> touched = {});
    ~Encoding();
    Encoding(Encoding&&) noexcept;

    uint32_t inputs() const;
    uint32_t inputQuads() const;   // of a row of inputs: ceil(inputs / 4)
    uint32_t width() const;        // values a row of the result, a multiple of gpu::kFeaturePadding
    uint64_t featureCount() const; // trainable features, 0 without a grid; a multiple of 4

    // Uniform in +-1e-4 (Müller 2022, section 4).
    void initialise(std::span<float> features, uint64_t seed) const;

    // inputs: rows of inputQuads() single-precision quads; encoded: rows of width() / 4 quads of `precision`.
    // `features`: featureCount() floats.
    void encode(FrameGraph& graph, const RowCount& rows, BufferRange inputs, BufferRange features,
                BufferRange encoded) const;

    // Adds each row's gradient to the features it read. `encodedGradient`: rows of width() / 4 quads. `sums`:
    // 64-bit fixed-point sums, two words (low, high) a feature, independent of the order of additions;
    // `scale` is their unit's reciprocal. No-op without a grid. (kernel accumulate_grid_gradient)
    void accumulateGradient(FrameGraph& graph, const RowCount& rows, BufferRange inputs,
                            BufferRange encodedGradient, BufferRange sums) const;
    // gradients[i] = sums[i] / scale, and the sums are zero again.
    void takeGradient(FrameGraph& graph, BufferRange sums, BufferRange gradients) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace irradia
