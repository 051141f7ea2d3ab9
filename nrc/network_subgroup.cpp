#include "kernels/nrc.h"
#include "nrc/network_kernels.h"

namespace irradia {
namespace {

constexpr uint32_t kOutputsTogether = 16; // of weight_gradient_subgroup.comp

// Rows of a lane that are fastest on CPUs. Evaluating, four fill the vector registers, but of 128 neurons
// they leave the first-level cache; training, where stores cost as much, two are as fast and compile in half
// the time.
uint32_t inferRowsPerLane(const NetworkShape& shape) {
    return shape.width > 64 ? 2 : 4;
}
constexpr uint32_t kTrainRowsPerLane = 2;

} // namespace

NetworkKernels makeSubgroupKernels(Device& device, const NetworkConfig& config, const NetworkShape& shape,
                                   uint32_t rowsPerLane) {
    const bool half = config.precision == Precision::Half;
    const uint32_t inferRows = rowsPerLane > 0 ? rowsPerLane : inferRowsPerLane(shape);
    const uint32_t trainRows = rowsPerLane > 0 ? rowsPerLane : kTrainRowsPerLane;
    KernelOptions options;
    options.constants = shapeConstants(config, shape);
    NetworkKernels kernels;
    kernels.weightGradient = Kernel(
        device, half ? kernels::weight_gradient_subgroup_half : kernels::weight_gradient_subgroup, options);
    options.constants.push_back({7, inferRows});
    kernels.infer = Kernel(device, half ? kernels::infer_subgroup_half : kernels::infer_subgroup, options);
    options.constants.back().value = trainRows;
    kernels.forward =
        Kernel(device, half ? kernels::forward_subgroup_half : kernels::forward_subgroup, options);
    const KernelSource& backward = half ? kernels::backward_subgroup_half : kernels::backward_subgroup;
    kernels.backward = Kernel(device, backward, options);
    options.constants.push_back({9, 1});
    kernels.backwardToInputs = Kernel(device, backward, options);

    kernels.inferRows = kernels.infer.workgroupSize() * inferRows;
    kernels.forwardRows = kernels.forward.workgroupSize() * trainRows;
    kernels.weightBlocks = weightBlocks(shape, kOutputsTogether, device.subgroupSize());
    kernels.weightBlocksPerGroup = kernels.weightGradient.workgroupSize() / device.subgroupSize();
    return kernels;
}

} // namespace irradia
