#include "engine/error.h"
#include "kernels/learning.h"
#include "nrc/learning/network_kernels.h"
#include "shared/constants.h"
#include <algorithm>

namespace irradia {
namespace {

// Outputs of a block of the weights' gradient. The more, the fewer loads for each product; of 64 the unrolled
// code leaves the instruction cache.
constexpr uint32_t kGradientOutputs = 32;

// Rows of a lane that are fastest on CPUs: four fill the vector registers, but of 128 neurons they leave the
// first-level cache.
uint32_t fastestRowsPerLane(const NetworkShape& shape) {
    return shape.width > 64 ? 2 : 4;
}

} // namespace

NetworkKernels makeSubgroupKernels(Device& device, const NetworkConfig& config, const NetworkShape& shape,
                                   uint32_t rowsPerLane) {
    const bool half = config.precision == Precision::Half;
    const OptionalFeatures& has = device.features();
    if (!has.bufferDeviceAddress || !has.shaderInt64 || !has.subgroupBroadcastDynamicId)
        fail(ExitCode::NoDevice,
             "network: the subgroup form needs bufferDeviceAddress, shaderInt64 and "
             "shaderSubgroupBroadcastDynamicId, of which {} has not all",
             device.description().name);
    const uint32_t rows = rowsPerLane > 0 ? rowsPerLane : fastestRowsPerLane(shape);
    KernelOptions options;
    options.constants = shapeConstants(config, shape);
    NetworkKernels kernels;
    const uint32_t gradientOutputs = std::min(kGradientOutputs, shape.width);
    options.constants.push_back({gpu::kConstantOutputsTogether, gradientOutputs});
    kernels.weightGradient = Kernel(
        device, half ? kernels::weight_gradient_subgroup_half : kernels::weight_gradient_subgroup, options);
    options.constants.back() = {gpu::kConstantLaneRows, rows};
    kernels.infer = Kernel(device, half ? kernels::infer_subgroup_half : kernels::infer_subgroup, options);
    kernels.forward =
        Kernel(device, half ? kernels::forward_subgroup_half : kernels::forward_subgroup, options);
    const KernelSource& backward = half ? kernels::backward_subgroup_half : kernels::backward_subgroup;
    kernels.backward = Kernel(device, backward, options);
    options.constants.push_back({gpu::kConstantInputGradient, 1});
    kernels.backwardToInputs = Kernel(device, backward, options);

    kernels.inferRows = kernels.infer.workgroupSize() * rows;
    kernels.forwardRows = kernels.forward.workgroupSize() * rows;
    kernels.weightBlocks = weightBlocks(shape, gradientOutputs, device.subgroupSize());
    kernels.weightBlocksPerGroup = kernels.weightGradient.workgroupSize() / device.subgroupSize();
    return kernels;
}

} // namespace irradia
