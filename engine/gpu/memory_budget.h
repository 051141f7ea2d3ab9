// How much memory of a device this program may count on.
#pragma once

#include <cstdint>
#include <vulkan/vulkan.h>

namespace irradia {

// Bytes that are there now: the largest device-local heap less what others hold of it (where the driver
// tells: VK_EXT_memory_budget), and where the device shares the machine's memory no more than the machine has
// available.
uint64_t memoryThere(VkPhysicalDevice physical, VkPhysicalDeviceType type, bool driverTellsBudget);

} // namespace irradia
