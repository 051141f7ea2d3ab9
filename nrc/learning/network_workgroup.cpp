#include "engine/error.h"
#include "kernels/learning.h"
#include "nrc/learning/network_kernels.h"
#include "shared/constants.h"
#include <algorithm>

namespace irradia {
namespace {

constexpr uint32_t kSharedLimit = 32u << 10; // more would keep a second workgroup off most GPUs' cores
constexpr uint32_t kLargestTile = 64;
constexpr uint32_t kSmallestTile = 16;
constexpr uint32_t kThreadRows = 4;    // of mlp_workgroup.glsl
constexpr uint32_t kThreadOutputs = 8; // of weight_gradient_workgroup.comp
constexpr uint32_t kStagedRows = 32;   // likewise

// Rows that a workgroup keeps, and outputs whose weights pass through its shared memory together.
struct Tile {
    uint32_t rows;
    uint32_t outputs;
    uint32_t bytes;
    uint32_t threads() const { return rows / kThreadRows * std::min(outputs / 4, 8u); }
};

Tile chooseTile(const Device& device, const NetworkShape& shape) {
    const uint32_t limit = std::min(kSharedLimit, device.limits().maxComputeSharedMemorySize);
    Tile tile{};
    for (uint32_t rows = kLargestTile; rows >= kSmallestTile; rows /= 2) {
        const uint32_t outputs = std::min(rows, shape.width);
        tile = {rows, outputs, (rows + outputs) * shape.largestQuads() * shape.quadBytes};
        if (tile.bytes <= limit) return tile;
    }
    fail(ExitCode::BadData,
         "network: {} rows of {} values and the weights of {} outputs take {} bytes of shared memory, of "
         "which {} "
         "may be used: fewer inputs, half precision or the subgroup form fit",
         tile.rows, shape.largestQuads() * 4, tile.outputs, tile.bytes, limit);
}

// A block of the weight gradient: outputs by quads of inputs, one workgroup.
struct GradientBlock {
    uint32_t outputs;
    uint32_t quads;
    uint32_t threads() const { return outputs / kThreadOutputs * quads; }
    uint32_t bytes() const { return kStagedRows * (outputs / 4 + quads) * 16; }
};

KernelOptions workgroupOptions(const NetworkConfig& config, const NetworkShape& shape, uint32_t threads) {
    KernelOptions options;
    options.constants = shapeConstants(config, shape);
    options.workgroupSize = threads;
    options.pinSubgroup = false;
    return options;
}

} // namespace

NetworkKernels makeWorkgroupKernels(Device& device, const NetworkConfig& config, const NetworkShape& shape) {
    const bool half = config.precision == Precision::Half;
    const Tile tile = chooseTile(device, shape);
    KernelOptions options = workgroupOptions(config, shape, tile.threads());
    options.constants.push_back({gpu::kConstantGroupRows, tile.rows});
    options.constants.push_back({gpu::kConstantGroupOutputs, tile.outputs});
    NetworkKernels kernels;
    kernels.infer = Kernel(device, half ? kernels::infer_workgroup_half : kernels::infer_workgroup, options);
    kernels.forward =
        Kernel(device, half ? kernels::forward_workgroup_half : kernels::forward_workgroup, options);
    const KernelSource& backward = half ? kernels::backward_workgroup_half : kernels::backward_workgroup;
    kernels.backward = Kernel(device, backward, options);
    options.constants.push_back({gpu::kConstantInputGradient, 1});
    kernels.backwardToInputs = Kernel(device, backward, options);
    kernels.inferRows = kernels.forwardRows = tile.rows;

    const GradientBlock block{std::min(64u, shape.width), std::min(16u, shape.widthQuads())};
    options = workgroupOptions(config, shape, block.threads());
    options.constants.push_back({gpu::kConstantOutputsTogether, block.outputs});
    options.constants.push_back({gpu::kConstantQuadsTogether, block.quads});
    kernels.weightGradient = Kernel(
        device, half ? kernels::weight_gradient_workgroup_half : kernels::weight_gradient_workgroup, options);
    kernels.weightBlocks = weightBlocks(shape, block.outputs, block.quads);
    kernels.sharedBytes = std::max(tile.bytes, block.bytes());
    return kernels;
}

} // namespace irradia
