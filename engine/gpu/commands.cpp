#include "engine/gpu/commands.h"

namespace irradia {
namespace {

void globalBarrier(VkCommandBuffer commands, VkPipelineStageFlags afterStages, VkAccessFlags after) {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = after;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, afterStages, 0, 1, &barrier, 0,
                         nullptr, 0, nullptr);
}

} // namespace

void orderAfterEarlierSubmissions(VkCommandBuffer commands) {
    globalBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                  VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT);
}

void orderBeforeHostReads(VkCommandBuffer commands) {
    globalBarrier(commands, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

OneTimeCommands::OneTimeCommands(const Device& device)
    : device_(device) {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = device.queueFamily();
    check(vkCreateCommandPool(device.handle(), &pool, nullptr, &pool_), "vkCreateCommandPool");
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool_;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device.handle(), &info, &commands_), "vkAllocateCommandBuffers");
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    orderAfterEarlierSubmissions(commands_);
}

OneTimeCommands::~OneTimeCommands() {
    if (!device_.abandoned()) vkDestroyCommandPool(device_.handle(), pool_, nullptr);
}

void OneTimeCommands::submitAndWait(const std::string& what) {
    orderBeforeHostReads(commands_);
    check(vkEndCommandBuffer(commands_), what);
    device_.submitAndWait(commands_, what);
}

} // namespace irradia
