// What a compute shader's SPIR-V says of its interface.
#pragma once

#include "engine/gpu/kernel.h"

namespace irradia {

struct Reflection {
    std::vector<KernelBinding> bindings;
    uint32_t pushBytes = 0;
    std::vector<uint32_t> constants; // ids of the specialisation constants, ascending
};

// Throws Error(Internal), naming the kernel, where bindings are not 0..n-1 of set 0 or of a kind kernels
// don't use.
Reflection reflect(const std::string& kernel, std::span<const uint32_t> spirv);

} // namespace irradia
