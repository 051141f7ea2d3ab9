// The memory of a device: the plan, the budget, and allocations within it.
#include "engine/error.h"
#include "engine/gpu/device_state.h"
#include "engine/log.h"
#include <algorithm>
#include <bit>
#include <cstdio>
#include <numeric>
#include <span>

namespace irradia {
namespace {

double mebibytes(uint64_t bytes) {
    return static_cast<double>(bytes) / (1024.0 * 1024.0);
}

// "rays 48.0, hits 16.0, bvh 12.3": the largest three, in MiB.
std::string largestOf(std::vector<Device::PlannedBuffer> buffers) {
    std::sort(buffers.begin(), buffers.end(), [](const auto& a, const auto& b) { return a.bytes > b.bytes; });
    std::string list;
    for (const Device::PlannedBuffer& buffer : std::span(buffers).first(std::min<size_t>(buffers.size(), 3)))
        list += fmt::format("{}{} {:.1f}", list.empty() ? "" : ", ", buffer.name, mebibytes(buffer.bytes));
    return list;
}

// The memory type, among those the buffer allows, that has all of `required` and most of `wanted`, and the
// fewest other properties; UINT32_MAX if none.
uint32_t findMemoryType(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed,
                        VkMemoryPropertyFlags required, VkMemoryPropertyFlags wanted) {
    uint32_t best = UINT32_MAX;
    int bestScore = 0;
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
        if (!(allowed & (1u << i)) || (flags & required) != required) continue;
        const int score = 100 + 16 * std::popcount(flags & wanted) - std::popcount(flags & ~wanted);
        if (score > bestScore) {
            best = i;
            bestScore = score;
        }
    }
    return best;
}

} // namespace

uint64_t Device::memoryUsed() const {
    return state_->memoryUsed;
}

uint64_t Device::memoryBudget() const {
    return state_->memoryBudget;
}

void Device::plan(const std::vector<PlannedBuffer>& buffers) const {
    const uint64_t sum = std::accumulate(buffers.begin(), buffers.end(), uint64_t{0},
                                         [](uint64_t total, const auto& b) { return total + b.bytes; });
    const std::string largest = largestOf(buffers);
    logLine("memory: {:.1f} MiB planned ({}), {:.1f} used, budget {:.0f}", mebibytes(sum), largest,
            mebibytes(memoryUsed()), mebibytes(memoryBudget()));
    if (sum > state_->memoryLeft())
        fail(
            ExitCode::OutOfMemory,
            "{}: {:.1f} MiB are planned and {:.1f} MiB used, more than the budget of {:.1f} MiB; largest: {}",
            description().name, mebibytes(sum), mebibytes(memoryUsed()), mebibytes(memoryBudget()), largest);
}

VkDeviceMemory Device::allocate(VkBuffer buffer, bool hostVisible, const std::string& name,
                                uint64_t& allocated) {
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(handle(), buffer, &needs);
    if (needs.size > state_->memoryLeft())
        fail(ExitCode::OutOfMemory,
             "buffer {}: {:.1f} MiB do not fit the budget of {:.1f} MiB, of which {:.1f} are used", name,
             mebibytes(needs.size), mebibytes(memoryBudget()), mebibytes(memoryUsed()));
    if (needs.size > state_->physical.maxAllocation)
        fail(ExitCode::OutOfMemory,
             "buffer {}: {:.1f} MiB are more than the device allocates at once ({:.1f} MiB)", name,
             mebibytes(needs.size), mebibytes(state_->physical.maxAllocation));

    constexpr VkMemoryPropertyFlags kMapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    if (features().bufferDeviceAddress) info.pNext = &flags;
    info.allocationSize = needs.size;
    info.memoryTypeIndex =
        findMemoryType(state_->memory, needs.memoryTypeBits, hostVisible ? kMapped : 0,
                       hostVisible ? kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT : kLocal);
    if (info.memoryTypeIndex == UINT32_MAX)
        fail(ExitCode::Internal, "buffer {}: no memory type fits it", name);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(handle(), &info, nullptr, &memory),
          fmt::format("buffer {}: {:.1f} MiB", name, mebibytes(needs.size)));
    allocated = needs.size;
    state_->memoryUsed += needs.size;
    return memory;
}

void Device::release(VkDeviceMemory memory, uint64_t allocated) {
    vkFreeMemory(handle(), memory, nullptr);
    state_->memoryUsed -= allocated;
}

} // namespace irradia
