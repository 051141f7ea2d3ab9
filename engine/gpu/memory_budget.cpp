#include "engine/gpu/memory_budget.h"
#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace irradia {
namespace {

constexpr uint64_t kUnknown = std::numeric_limits<uint64_t>::max();

// "MemAvailable:   24000000 kB" of /proc/meminfo: what can be had without swapping.
uint64_t machineAvailable() {
    std::ifstream file("/proc/meminfo");
    std::string key;
    uint64_t kilobytes = 0;
    while (file >> key >> kilobytes) {
        if (key == "MemAvailable:") return kilobytes * 1024;
        file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    return kUnknown;
}

// The limit of a container or batch job (control groups, version 2); "max" where there is none.
uint64_t controlGroupLimit() {
    std::ifstream file("/sys/fs/cgroup/memory.max");
    uint64_t bytes = 0;
    return file >> bytes ? bytes : kUnknown;
}

} // namespace

uint64_t memoryThere(VkPhysicalDevice physical, VkPhysicalDeviceType type, bool driverTellsBudget) {
    VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT};
    VkPhysicalDeviceMemoryProperties2 memory{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2};
    if (driverTellsBudget) memory.pNext = &budget;
    vkGetPhysicalDeviceMemoryProperties2(physical, &memory);

    uint64_t there = 0;
    for (uint32_t i = 0; i < memory.memoryProperties.memoryHeapCount; ++i) {
        const VkMemoryHeap& heap = memory.memoryProperties.memoryHeaps[i];
        if (!(heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)) continue;
        const uint64_t told = budget.heapBudget[i] - std::min(budget.heapBudget[i], budget.heapUsage[i]);
        there = std::max(there, driverTellsBudget ? std::min(told, heap.size) : heap.size);
    }
    const bool shared = type == VK_PHYSICAL_DEVICE_TYPE_CPU || type == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
    return shared ? std::min({there, machineAvailable(), controlGroupLimit()}) : there;
}

} // namespace irradia
