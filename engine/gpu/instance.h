// The Vulkan instance, with the validation layer and its messenger when asked for.
#pragma once

#include <atomic>
#include <cstdint>
#include <vulkan/vulkan.h>

namespace irradia {

class Instance {
public:
    explicit Instance(
        bool validation); // throws Error(NoDevice) where there is no driver or no validation layer
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance handle() const { return instance_; }
    bool debugUtils() const { return debugUtils_; }
    uint64_t messages() const { return messages_; }

private:
    VkDebugUtilsMessengerCreateInfoEXT messengerInfo();
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    bool debugUtils_ = false;
    std::atomic<uint64_t> messages_ = 0;
};

} // namespace irradia
