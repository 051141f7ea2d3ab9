#include "engine/gpu/device.h"
#include "engine/error.h"
#include "engine/gpu/device_state.h"
#include <bit>
#include <cstdlib>
#include <string_view>

namespace irradia {

Device::State::~State() {
    if (fence != VK_NULL_HANDLE) vkDestroyFence(device, fence, nullptr);
    if (device != VK_NULL_HANDLE) vkDestroyDevice(device, nullptr);
}

namespace {

bool wantsValidation(const DeviceOptions& options) {
    const char* variable = std::getenv("IRRADIA_VALIDATION");
    return options.validation || (variable && std::string_view(variable) == "1");
}

uint32_t chooseSubgroupSize(const PhysicalDevice& device, uint32_t wanted) {
    const uint32_t native = device.description.subgroupSize;
    if (wanted == 0 || wanted == native) return native;
    const std::string& name = device.description.name;
    const char* hint =
        device.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU
            ? "; lavapipe's is set by LP_NATIVE_VECTOR_WIDTH = 128, 256 or 512 (4, 8 or 16 lanes)"
            : "";
    if (!device.subgroupSizeControl)
        fail(ExitCode::NoDevice, "{} runs subgroups of {} and cannot be pinned to {}{}", name, native, wanted,
             hint);
    if (!std::has_single_bit(wanted) || wanted < device.minSubgroupSize || wanted > device.maxSubgroupSize)
        fail(ExitCode::NoDevice, "{} has subgroups of {} to {}, not of {}{}", name, device.minSubgroupSize,
             device.maxSubgroupSize, wanted, hint);
    return wanted;
}

bool chooseTexelQuads(const PhysicalDevice& device, QuadAccess quads) {
    if (quads == QuadAccess::Texel && !device.texelShortcoming.empty())
        fail(ExitCode::NoDevice, "{} cannot read quads through texel views: {}", device.description.name,
             device.texelShortcoming);
    return quads == QuadAccess::Auto ? device.texelShortcoming.empty() : quads == QuadAccess::Texel;
}

VkDevice createDevice(const PhysicalDevice& physical) {
    VkPhysicalDeviceSubgroupSizeControlFeatures control{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES};
    control.subgroupSizeControl = VK_TRUE;
    control.computeFullSubgroups = VK_TRUE;
    const OptionalFeatures& has = physical.features;
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    v12.bufferDeviceAddress = has.bufferDeviceAddress;
    v12.subgroupBroadcastDynamicId = has.subgroupBroadcastDynamicId;
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    features.features.robustBufferAccess = VK_TRUE;
    features.features.shaderInt64 = has.shaderInt64;
    features.pNext = &v12;

    std::vector<const char*> extensions;
    if (physical.subgroupSizeControl) {
        extensions.push_back(VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME);
        v12.pNext = &control;
    }
    if (physical.memoryBudget) extensions.push_back(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = physical.queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkDevice device = VK_NULL_HANDLE;
    check(vkCreateDevice(physical.handle, &info, nullptr, &device),
          "vkCreateDevice on " + physical.description.name);
    return device;
}

} // namespace

Device::Device(const DeviceOptions& options)
    : state_(std::make_unique<State>(wantsValidation(options))) {
    State& s = *state_;
    s.physical = choose(physicalDevices(s.instance), options.select);
    s.subgroupSize = chooseSubgroupSize(s.physical, options.subgroupSize);
    s.texelQuads = chooseTexelQuads(s.physical, options.quads);
    s.device = createDevice(s.physical);
    vkGetDeviceQueue(s.device, s.physical.queueFamily, 0, &s.queue);
    VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vkCreateFence(s.device, &fence, nullptr, &s.fence), "vkCreateFence");
    vkGetPhysicalDeviceMemoryProperties(s.physical.handle, &s.memory);
    const uint64_t there = s.physical.description.memoryBytes;
    s.memoryBudget = static_cast<uint64_t>(static_cast<double>(there) * options.memoryShare);
    if (s.instance.debugUtils())
        s.setName = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
            vkGetInstanceProcAddr(s.instance.handle(), "vkSetDebugUtilsObjectNameEXT"));
}

Device::~Device() {
    if (state_->abandoned) static_cast<void>(state_.release()); // it goes with the process
}

const DeviceDescription& Device::description() const {
    return state_->physical.description;
}
bool Device::isCpu() const {
    return state_->physical.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
}
bool Device::sharesMemory() const {
    return isCpu() || state_->physical.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
}
uint32_t Device::subgroupSize() const {
    return state_->subgroupSize;
}
uint32_t Device::nativeSubgroupSize() const {
    return description().subgroupSize;
}
bool Device::canPinSubgroupSize() const {
    return state_->physical.subgroupSizeControl;
}
uint32_t Device::maxPinnedWorkgroup() const {
    return state_->physical.maxSubgroups * subgroupSize();
}
bool Device::texelQuads() const {
    return state_->texelQuads;
}
bool Device::runsInOrder() const {
    return state_->physical.isLavapipe && !state_->validation;
}
bool Device::storesByAddress() const {
    return isCpu() && features().bufferDeviceAddress && features().shaderInt64;
}
const OptionalFeatures& Device::features() const {
    return state_->physical.features;
}
const VkPhysicalDeviceLimits& Device::limits() const {
    return state_->physical.properties.limits;
}
uint64_t Device::validationMessages() const {
    return state_->instance.messages();
}
bool Device::abandoned() const {
    return state_->abandoned;
}
VkInstance Device::instance() const {
    return state_->instance.handle();
}
VkDevice Device::handle() const {
    return state_->device;
}
VkQueue Device::queue() const {
    return state_->queue;
}
uint32_t Device::queueFamily() const {
    return state_->physical.queueFamily;
}
float Device::timestampPeriodNs() const {
    return state_->physical.timestampBits > 0 ? limits().timestampPeriod : 0.0f;
}

void Device::submit(VkCommandBuffer commands, VkFence fence, const std::string& what) const {
    check(vkResetFences(state_->device, 1, &fence), what);
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    const VkResult result = vkQueueSubmit(state_->queue, 1, &submit, fence);
    if (result == VK_ERROR_DEVICE_LOST) fail(ExitCode::Internal, "{}: {} was lost", what, description().name);
    check(result, what);
}

void Device::wait(VkFence fence, const std::string& what, double timeoutSeconds) const {
    const auto nanoseconds = static_cast<uint64_t>(timeoutSeconds * 1e9);
    const VkResult result = vkWaitForFences(state_->device, 1, &fence, VK_TRUE, nanoseconds);
    if (result == VK_TIMEOUT) {
        state_->abandoned = true;
        fail(ExitCode::Internal, "{}: {} did not finish within {} s", what, description().name,
             timeoutSeconds);
    }
    if (result == VK_ERROR_DEVICE_LOST) fail(ExitCode::Internal, "{}: {} was lost", what, description().name);
    check(result, what);
}

void Device::submitAndWait(VkCommandBuffer commands, const std::string& what, double timeoutSeconds) const {
    submit(commands, state_->fence, what);
    wait(state_->fence, what, timeoutSeconds);
}

void Device::label(VkObjectType type, uint64_t object, const std::string& name) const {
    if (!state_->setName) return;
    VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    info.objectType = type;
    info.objectHandle = object;
    info.pObjectName = name.c_str();
    state_->setName(handle(), &info);
}

} // namespace irradia
