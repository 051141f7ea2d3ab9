// What the machine's Vulkan devices are and can do, and the choice of one of them.
#pragma once

#include "engine/gpu/device.h"
#include "engine/gpu/instance.h"

namespace irradia {

struct PhysicalDevice {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties{};
    DeviceDescription description;
    OptionalFeatures features;
    bool isLavapipe = false;
    bool subgroupSizeControl = false; // VK_EXT_subgroup_size_control, for compute, with whole subgroups
    uint32_t minSubgroupSize = 0;
    uint32_t maxSubgroupSize = 0;
    uint32_t maxSubgroups = 0;    // of a workgroup of pinned subgroups
    bool memoryBudget = false;    // VK_EXT_memory_budget
    uint64_t maxAllocation = 0;   // bytes of one allocation
    std::string texelShortcoming; // why quads cannot be read through texel views; empty if they can
    uint32_t queueFamily = 0;     // the first with compute
    uint32_t timestampBits = 0;   // of that queue
};

std::vector<PhysicalDevice> physicalDevices(const Instance& instance);

// The device that `select` means (see DeviceOptions); throws Error(NoDevice) naming the devices there are.
const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices, const std::string& select);

} // namespace irradia
