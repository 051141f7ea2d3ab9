#include "nrc/learning/network_kernels.h"

#include "engine/error.h"
#include "kernels/learning.h"
#include "shared/constants.h"
#include <algorithm>

namespace irradia {

NetworkShape checkedShape(const NetworkConfig& config, uint32_t inputs, uint32_t outputs) {
    if (config.width != 16 && config.width != 32 && config.width != 64 && config.width != 128)
        fail(ExitCode::BadData, "network: layers of {} neurons; there are kernels for 16, 32, 64 and 128",
             config.width);
    if (config.hiddenLayers < 1 || config.hiddenLayers > 8)
        fail(ExitCode::BadData, "network: {} hidden layers; 1 to 8 are possible", config.hiddenLayers);
    if (outputs < 1 || outputs > gpu::kFeaturePadding)
        fail(ExitCode::BadData, "network: {} outputs; 1 to {} are possible", outputs, gpu::kFeaturePadding);
    if (inputs == 0 || inputs % gpu::kFeaturePadding != 0)
        fail(ExitCode::BadData, "network: {} inputs, which is no multiple of {}", inputs,
             gpu::kFeaturePadding);
    return {inputs, config.width, config.hiddenLayers, outputs,
            config.precision == Precision::Half ? 8u : 16u};
}

std::vector<Specialisation> shapeConstants(const NetworkConfig& config, const NetworkShape& shape) {
    return {{gpu::kConstantInputQuads, shape.inputQuads()},
            {gpu::kConstantWidthQuads, shape.widthQuads()},
            {gpu::kConstantHiddenLayers, shape.hiddenLayers},
            {gpu::kConstantOutputQuads, shape.outputQuads()},
            {gpu::kConstantOutputActivation, static_cast<uint32_t>(config.outputActivation)}};
}

uint32_t weightBlocks(const NetworkShape& shape, uint32_t outputsTogether, uint32_t quadsTogether) {
    const auto across = [&](uint32_t quads) { return (quads + quadsTogether - 1) / quadsTogether; };
    const uint32_t down = shape.width / outputsTogether;
    return down * across(shape.inputQuads()) +
           ((shape.hiddenLayers - 1) * down + 1) * across(shape.widthQuads());
}

NetworkKernels makeNetworkKernels(Device& device, const NetworkConfig& config, const NetworkShape& shape,
                                  uint32_t rowsPerLane) {
    NetworkKernels kernels = config.form == NetworkForm::Subgroup
                                 ? makeSubgroupKernels(device, config, shape, rowsPerLane)
                                 : makeWorkgroupKernels(device, config, shape);
    KernelOptions options;
    options.constants = shapeConstants(config, shape);
    const bool half = config.precision == Precision::Half;
    kernels.pack = Kernel(device, half ? kernels::pack_weights_half : kernels::pack_weights, options);
    kernels.sumGradients = Kernel(device, kernels::sum_gradients);
    return kernels;
}

} // namespace irradia
