// The kernels of a network in one of its two forms:
//   subgroup   a lane owns rows, activations in registers, weights spread by broadcasts: fast on CPUs
//   workgroup  a workgroup owns a tile of rows, activations and weights in shared memory: fast on GPUs
// A third form, with cooperative matrices, would be a third such file beside these two.
#pragma once

#include "engine/gpu/kernel.h"
#include "nrc/learning/network_shape.h"

namespace irradia {

struct NetworkKernels {
    Kernel infer, forward, backward, backwardToInputs, weightGradient, pack, sumGradients;
    uint32_t inferRows = 0;   // of a workgroup
    uint32_t forwardRows = 0; // likewise, forward and backward
    uint32_t weightBlocks = 0;
    uint32_t weightBlocksPerGroup = 1;
    uint32_t sharedBytes = 0; // of a workgroup, the most of all kernels

    uint32_t inferGroups(uint32_t rows) const { return (rows + inferRows - 1) / inferRows; }
    uint32_t forwardGroups(uint32_t rows) const { return (rows + forwardRows - 1) / forwardRows; }
    uint32_t weightGradientGroups(uint32_t chunks) const {
        const uint32_t blocks = chunks * weightBlocks;
        return (blocks + weightBlocksPerGroup - 1) / weightBlocksPerGroup;
    }
};

// rowsPerLane as Network has it. Throws Error(BadData) where the shape does not fit into the device's shared
// memory.
NetworkKernels makeNetworkKernels(Device& device, const NetworkConfig& config, const NetworkShape& shape,
                                  uint32_t rowsPerLane);

// What kernels of all forms are specialised with: shaders/learning/mlp_shape.glsl.
std::vector<Specialisation> shapeConstants(const NetworkConfig& config, const NetworkShape& shape);

// How many blocks of so many outputs by so many quads of inputs tile all matrices:
// shaders/learning/weight_blocks.glsl.
uint32_t weightBlocks(const NetworkShape& shape, uint32_t outputsTogether, uint32_t quadsTogether);

NetworkKernels makeSubgroupKernels(Device& device, const NetworkConfig& config, const NetworkShape& shape,
                                   uint32_t rowsPerLane);
NetworkKernels makeWorkgroupKernels(Device& device, const NetworkConfig& config, const NetworkShape& shape);

} // namespace irradia
