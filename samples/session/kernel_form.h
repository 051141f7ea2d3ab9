// Forms of kernels that do the same, by one name: how they read the quads of queues (texel, storage), or how
// networks are computed (subgroup, workgroup).
#pragma once

#include "engine/gpu/device.h"
#include "nrc/learning/config.h"
#include <string>
#include <vector>

namespace irradia {

struct KernelForm {
    QuadAccess access = QuadAccess::Auto;
    NetworkForm network = NetworkForm::Auto; // Auto: as it is configured
};

std::vector<std::string> kernelFormNames(); // "auto", which leaves both to the device, first
// Throws Error(Usage) naming those there are.
KernelForm kernelForm(const std::string& name);

// "texel" or "storage": what a device has come to.
const char* accessName(const Device& device);

} // namespace irradia
