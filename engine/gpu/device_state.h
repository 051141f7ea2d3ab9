// What a Device holds, for the files that implement it.
#pragma once

#include "engine/gpu/device.h"
#include "engine/gpu/physical_device.h"
#include <algorithm>

namespace irradia {

struct Device::State {
    explicit State(bool validate)
        : validation(validate)
        , instance(validate) {}
    ~State();
    uint64_t memoryLeft() const { return memoryBudget - std::min(memoryUsed, memoryBudget); }

    bool validation;
    Instance instance;
    PhysicalDevice physical;
    uint32_t subgroupSize = 0;
    bool texelQuads = false;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    bool abandoned = false;
    VkPhysicalDeviceMemoryProperties memory{};
    uint64_t memoryBudget = 0;
    uint64_t memoryUsed = 0;
    PFN_vkSetDebugUtilsObjectNameEXT setName = nullptr;
};

} // namespace irradia
