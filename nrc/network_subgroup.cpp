#include "kernels/nrc.h"
#include "nrc/network_kernels.h"

namespace irradia {
namespace {

constexpr uint32_t kOutputsTogether = 16; // of weight_gradient_subgroup.glsl

// With four outputs computed together they fill a CPU's vector registers; three rows are as fast within the
// noise, two a fifth slower.
constexpr uint32_t kDefaultRowsPerLane = 4;

} // namespace

NetworkKernels makeSubgroupKernels(Device& device, const NetworkConfig& config, const NetworkShape& shape,
                                   uint32_t rowsPerLane) {
    const bool half = config.precision == Precision::Half;
    const uint32_t rows = rowsPerLane > 0 ? rowsPerLane : kDefaultRowsPerLane;
    KernelOptions options;
    options.constants = shapeConstants(config, shape);
    NetworkKernels kernels;
    kernels.weightGradient = Kernel(
        device, half ? kernels::weight_gradient_subgroup_half : kernels::weight_gradient_subgroup, options);
    options.constants.push_back({7, rows});
    kernels.infer = Kernel(device, half ? kernels::infer_subgroup_half : kernels::infer_subgroup, options);
    kernels.forward =
        Kernel(device, half ? kernels::forward_subgroup_half : kernels::forward_subgroup, options);
    const KernelSource& backward = half ? kernels::backward_subgroup_half : kernels::backward_subgroup;
    kernels.backward = Kernel(device, backward, options);
    options.constants.push_back({9, 1});
    kernels.backwardToInputs = Kernel(device, backward, options);

    kernels.inferRows = kernels.forwardRows = kernels.infer.workgroupSize() * rows;
    kernels.weightBlocks = weightBlocks(shape, kOutputsTogether, device.subgroupSize());
    kernels.weightBlocksPerGroup = kernels.weightGradient.workgroupSize() / device.subgroupSize();
    return kernels;
}

} // namespace irradia
