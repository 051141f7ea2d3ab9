// A slice of an encoding on the device: what its kernels are made of, the passes that use them, and the
// features that it may have.
#pragma once

#include "engine/graph/frame_graph.h"
#include "nrc/learning/encoding_layout.h"
#include "nrc/learning/row_count.h"
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>

namespace irradia {

struct SliceContext {
    Device& device;
    const EncodingLayout& layout;
    const EncodingSlice& slice;
    Precision precision;
    uint64_t features; // of all slices
};

// A kernel that includes shaders/learning/encode.glsl. `own`: its constants from gpu::kConstantOwn on.
Kernel makeSliceKernel(const SliceContext& context, const KernelSource& single, const KernelSource& half,
                       std::span<const uint32_t> own);

gpu::RowsParams rowsParams(const RowCount& rows);

class SlicePasses {
public:
    virtual ~SlicePasses() = default;
    // As those of Encoding. `features` and `sums`: of all slices.
    virtual void encode(FrameGraph& graph, const RowCount& rows, BufferRange inputs, BufferRange features,
                        BufferRange encoded) const = 0;
    virtual void accumulateGradient(FrameGraph&, const RowCount&, BufferRange /*inputs*/,
                                    BufferRange /*encodedGradient*/, BufferRange /*sums*/) const {}
};

// Of an encoding without features.
std::unique_ptr<SlicePasses> makePlainPasses(const SliceContext& context);

// Where a slice's features may lie.
struct FeatureRoom {
    uint64_t first; // feature of all slices, a multiple of kFeatureAlignment
    const VkPhysicalDeviceLimits& limits;
    std::span<const glm::vec3> touched; // points of the unit cube
};

// Features are whole quads, and whole entries of any grid.
constexpr uint64_t kFeatureAlignment = 16;

// The features of a slice, laid out without a device.
class SliceFeatures {
public:
    virtual ~SliceFeatures() = default;
    virtual uint64_t end() const = 0; // the first feature behind them
    // CRC-32 of which features there are, where the touched points decide it, behind `before`.
    virtual std::optional<uint32_t> checksumBehind(uint32_t /*before*/) const { return {}; }
    virtual std::unique_ptr<SlicePasses> makePasses(const SliceContext& context) const = 0;
};

} // namespace irradia
