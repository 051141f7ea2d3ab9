// Encodings of network inputs, composed over slices of the input: nrc/learning/encodings has those there are,
// some with features that are learned.
//
// Each part's values begin at a multiple of four; gaps, and the padding to a multiple of kFeaturePadding,
// hold ones, which act as bias of the first layer.
#pragma once

#include "engine/graph/frame_graph.h"
#include "nrc/learning/config.h"
#include "nrc/learning/row_count.h"
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>

namespace irradia {

class Encoding {
public:
    // `inputs` values a row, from which the parts take theirs in order. Directions of spherical harmonics are
    // unit vectors; positions of grids are moved into the unit cube. `touched`: points of that cube whose
    // voxels a SparseGrid stores; it is refused without any. Throws Error(BadData) where parts and inputs do
    // not fit, Error(OutOfMemory) with the numbers where a grid outgrows a binding.
    Encoding(Device& device, const std::vector<EncodingConfig>& parts, uint32_t inputs, Precision precision,
             std::span<const glm::vec3> touched = {});
    ~Encoding();
    Encoding(Encoding&&) noexcept;

    uint32_t inputs() const;
    uint32_t inputQuads() const;   // of a row of inputs: ceil(inputs / 4)
    uint32_t width() const;        // values a row of the result, a multiple of gpu::kFeaturePadding
    uint64_t featureCount() const; // trainable features, 0 without a grid; a multiple of 4
    // CRC-32 of which corners the sparse grids store: only between equal ones may features be exchanged. None
    // where no grid is sparse.
    std::optional<uint32_t> storedCorners() const;

    // Uniform in +-1e-4 (Müller 2022, section 4).
    void initialise(std::span<float> features, uint64_t seed) const;

    // inputs: rows of inputQuads() single-precision quads; encoded: rows of width() / 4 quads of `precision`.
    // `features`: featureCount() floats.
    void encode(FrameGraph& graph, const RowCount& rows, BufferRange inputs, BufferRange features,
                BufferRange encoded) const;

    // Adds each row's gradient to the sums of the features it read: no-op without a grid. `encodedGradient`:
    // rows of width() / 4 quads of `precision`. `sums`: sumBytes() that are zero at first; 64-bit fixed-point
    // sums in units of 2^-20, independent of the order of rows. So give it gradients of a row's own loss, not
    // divided by the number of rows: below 2^-21 they vanish, and beyond +-2047 a contribution is cut.
    uint64_t sumBytes() const; // 8 a feature
    void accumulateGradient(FrameGraph& graph, const RowCount& rows, BufferRange inputs,
                            BufferRange encodedGradient, BufferRange sums) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace irradia
