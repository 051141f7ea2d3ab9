// One Vulkan device with its compute queue and the budget of memory this program allows itself on it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>
#include <vulkan/vulkan.h>

namespace irradia {

// How kernels read quads: texel views are the fast form on lavapipe; storage buffers serve devices whose
// maxTexelBufferElements is too small for a full 128 MiB binding.
enum class QuadAccess { Auto, Texel, Storage };

struct DeviceOptions {
    std::string select;        // index, part of a name (any case), "cpu", "gpu"; empty = first GPU, else CPU
    bool validation = false;   // core and synchronisation validation; messages are counted and logged
    uint32_t subgroupSize = 0; // 0 = the device's own; else pinned where the device has it, refused otherwise
    QuadAccess quads = QuadAccess::Auto;
    double memoryShare = 0.8; // of the device's memory that is there: plans above it are refused
};

// A line of `irradia devices`; `missing` names each required feature the device lacks.
struct DeviceDescription {
    uint32_t index = 0;
    std::string name;
    std::string driver;
    std::string type; // "cpu", "discrete gpu", "integrated gpu", "virtual gpu", "other"
    std::string apiVersion;
    uint32_t subgroupSize = 0;
    uint64_t memoryBytes = 0;
    std::vector<std::string> missing;
};
std::vector<DeviceDescription> listDevices();

// Features that are switched on where the device has them; a kernel that needs one asks first.
struct OptionalFeatures {
    bool bufferDeviceAddress = false;
    bool shaderInt64 = false;
    bool subgroupBroadcastDynamicId = false; // from a lane that is no constant
};

class Device {
public:
    explicit Device(const DeviceOptions& options = {}); // throws Error(NoDevice) naming what is missing
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceDescription& description() const;
    bool isCpu() const;
    bool sharesMemory() const;           // with the machine: a CPU, an integrated GPU
    uint32_t subgroupSize() const;       // the size kernels are pinned to
    bool canPinSubgroupSize() const;     // VK_EXT_subgroup_size_control (core in 1.3)
    uint32_t maxPinnedWorkgroup() const; // invocations of a workgroup whose subgroups are pinned
    uint32_t nativeSubgroupSize() const; // of kernels that are not pinned
    bool texelQuads() const;             // which form of the kernels is used
    const OptionalFeatures& features() const;
    // Each command is done before the next begins: barriers between the passes of a submission change
    // nothing, and are left out, since for each of them lavapipe wakes all threads of its rasteriser (0.1 ms
    // a pass with two threads, 0.03 ms without). False under validation, which is to see the barriers that
    // other devices need.
    bool runsInOrder() const;
    bool storesByAddress() const; // a CPU that can (shaders/lib/store_by_address.glsl), where it is faster
    const VkPhysicalDeviceLimits& limits() const;

    // Memory: plan() prints the sum and the largest of what is about to be allocated and throws
    // Error(OutOfMemory) naming the sum and the budget when it does not fit; every Buffer counts against it.
    struct PlannedBuffer {
        std::string name;
        uint64_t bytes = 0;
        uint64_t bound = 0; // bytes of it that a pass binds at most; 0 = all

        uint64_t largestBinding() const { return bound == 0 ? bytes : bound; }
    };
    void plan(const std::vector<PlannedBuffer>& buffers) const;
    uint64_t memoryUsed() const;
    uint64_t memoryBudget() const;

    // Validation messages (warnings and errors) seen since the start; tests require 0.
    uint64_t validationMessages() const;

    VkInstance instance() const;
    VkDevice handle() const;
    VkQueue queue() const;
    uint32_t queueFamily() const;
    float timestampPeriodNs() const; // 0 where the queue has no timestamps

    // Submits, and waits on a fence; each throws Error(Internal) naming `what` on a timeout or a lost device.
    // After a timeout the device may still be at work on anything it was given: then nothing is freed any
    // more. submit() resets the fence, which is the caller's; submitAndWait() has one of its own.
    bool abandoned() const;
    void submit(VkCommandBuffer commands, VkFence fence, const std::string& what) const;
    void wait(VkFence fence, const std::string& what, double timeoutSeconds) const;
    void submitAndWait(VkCommandBuffer commands, const std::string& what, double timeoutSeconds = 60.0) const;
    void label(VkObjectType type, uint64_t handle, const std::string& name) const; // debug name, if available

    // For Buffer alone: allocates within the budget.
    VkDeviceMemory allocate(VkBuffer buffer, bool hostVisible, const std::string& name, uint64_t& allocated);
    void release(VkDeviceMemory memory, uint64_t allocated);

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Throws Error(Internal) "what: VK_ERROR_..." unless result is VK_SUCCESS (device loss and out-of-memory by
// name).
void check(VkResult result, const std::string& what);

} // namespace irradia
