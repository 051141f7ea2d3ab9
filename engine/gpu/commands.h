// A command buffer that is recorded, submitted and waited for once.
#pragma once

#include "engine/gpu/device.h"

namespace irradia {

// Between the device's own earlier work and this one, and between this one and the host, memory is made
// visible.
class OneTimeCommands {
public:
    explicit OneTimeCommands(const Device& device);
    ~OneTimeCommands();
    OneTimeCommands(const OneTimeCommands&) = delete;
    OneTimeCommands& operator=(const OneTimeCommands&) = delete;

    VkCommandBuffer handle() const { return commands_; }
    void submitAndWait(const std::string& what);

private:
    const Device& device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

// What a submission begins with: all earlier submissions' writes become visible to everything in it. (A fence
// makes them available only.)
void orderAfterEarlierSubmissions(VkCommandBuffer commands);
// What it ends with where the host reads results.
void orderBeforeHostReads(VkCommandBuffer commands);

} // namespace irradia
