#include "engine/gpu/physical_device.h"
#include "engine/error.h"
#include "engine/gpu/memory_budget.h"
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace irradia {
namespace {

const char* typeName(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "cpu";
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete gpu";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated gpu";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual gpu";
    default:
        return "other";
    }
}

std::vector<VkExtensionProperties> extensionsOf(VkPhysicalDevice physical) {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
    return extensions;
}

// The first queue family with compute; false if there is none.
bool findQueue(PhysicalDevice& device) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, families.data());
    const auto found = std::find_if(families.begin(), families.end(),
                                    [](const auto& f) { return (f.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0; });
    if (found == families.end()) return false;
    device.queueFamily = static_cast<uint32_t>(found - families.begin());
    device.timestampBits = found->timestampValidBits;
    return true;
}

std::string texelShortcoming(const PhysicalDevice& device) {
    constexpr uint32_t kElements = 1u << 24; // far below a full binding kernels would need chunks everywhere
    const uint32_t elements = device.properties.limits.maxTexelBufferElements;
    if (elements < kElements)
        return fmt::format("maxTexelBufferElements is {}, less than {}", elements, kElements);
    using Named = std::pair<VkFormat, const char*>;
    for (const auto& [format, name] :
         std::array{Named{VK_FORMAT_R32G32B32A32_UINT, "rgba32ui"}, Named{VK_FORMAT_R32_UINT, "r32ui"},
                    Named{VK_FORMAT_R16G16B16A16_SFLOAT, "rgba16f"}}) {
        VkFormatProperties support{};
        vkGetPhysicalDeviceFormatProperties(device.handle, format, &support);
        if (!(support.bufferFeatures & VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_BIT))
            return fmt::format("{} is not supported in storage texel buffers", name);
    }
    return {};
}

void readProperties(PhysicalDevice& device, bool sizeControl) {
    VkPhysicalDeviceSubgroupSizeControlProperties control{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES};
    VkPhysicalDeviceSubgroupProperties subgroup{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceMaintenance3Properties allocation{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &driver;
    driver.pNext = &allocation;
    allocation.pNext = &subgroup;
    if (sizeControl) subgroup.pNext = &control;
    vkGetPhysicalDeviceProperties2(device.handle, &properties);

    device.maxAllocation = allocation.maxMemoryAllocationSize;
    device.minSubgroupSize = control.minSubgroupSize;
    device.maxSubgroupSize = control.maxSubgroupSize;
    device.maxSubgroups = control.maxComputeWorkgroupSubgroups;
    device.subgroupSizeControl = (control.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
    device.isLavapipe = driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE;
    device.description.driver = fmt::format("{} {}", driver.driverName, driver.driverInfo);
    device.description.subgroupSize = subgroup.subgroupSize;
    const bool compute = (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
    if (!compute || !(subgroup.supportedOperations & VK_SUBGROUP_FEATURE_BASIC_BIT))
        device.description.missing.push_back("basic subgroup operations in compute");
    if (!compute || !(subgroup.supportedOperations & VK_SUBGROUP_FEATURE_BALLOT_BIT))
        device.description.missing.push_back("subgroup ballot in compute");
}

void readFeatures(PhysicalDevice& device) {
    VkPhysicalDeviceSubgroupSizeControlFeatures control{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES};
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    features.pNext = &v12;
    if (device.subgroupSizeControl) v12.pNext = &control;
    vkGetPhysicalDeviceFeatures2(device.handle, &features);

    if (!features.features.robustBufferAccess) device.description.missing.push_back("robustBufferAccess");
    device.subgroupSizeControl = control.subgroupSizeControl && control.computeFullSubgroups;
    device.features.bufferDeviceAddress = v12.bufferDeviceAddress;
    device.features.shaderInt64 = features.features.shaderInt64;
    device.features.subgroupBroadcastDynamicId = v12.subgroupBroadcastDynamicId;
}

PhysicalDevice describe(VkPhysicalDevice handle, uint32_t index) {
    PhysicalDevice device;
    device.handle = handle;
    vkGetPhysicalDeviceProperties(handle, &device.properties);
    const uint32_t version = device.properties.apiVersion;
    DeviceDescription& description = device.description;
    description.index = index;
    description.name = device.properties.deviceName;
    description.type = typeName(device.properties.deviceType);
    description.apiVersion = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version),
                                         VK_API_VERSION_MINOR(version), VK_API_VERSION_PATCH(version));
    if (!findQueue(device)) description.missing.push_back("a compute queue");
    if (version < VK_API_VERSION_1_2) {
        description.missing.push_back("Vulkan 1.2");
        return device;
    }
    const std::vector<VkExtensionProperties> extensions = extensionsOf(handle);
    const auto has = [&](std::string_view name) {
        return std::any_of(extensions.begin(), extensions.end(),
                           [&](const auto& e) { return e.extensionName == name; });
    };
    device.memoryBudget = has(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    readProperties(device, has(VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME));
    readFeatures(device);
    device.texelShortcoming = texelShortcoming(device);
    description.memoryBytes = memoryThere(handle, device.properties.deviceType, device.memoryBudget);
    return device;
}

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

// Whether `select` may mean this device: its index, "gpu", its type ("cpu") or a part of its name.
bool matches(const PhysicalDevice& device, const std::string& select) {
    if (select.empty()) return true;
    if (std::all_of(select.begin(), select.end(), [](char c) { return c >= '0' && c <= '9'; }))
        return select == std::to_string(device.description.index);
    const bool cpu = device.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    if (lower(select) == "cpu") return cpu;
    if (lower(select) == "gpu") return !cpu;
    return lower(device.description.name).find(lower(select)) != std::string::npos;
}

// The order of preference where several devices match.
int rank(const PhysicalDevice& device) {
    switch (device.properties.deviceType) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_OTHER:
        return 3;
    default:
        return 4;
    }
}

} // namespace

std::vector<PhysicalDevice> physicalDevices(const Instance& instance) {
    uint32_t count = 0;
    const VkResult result = vkEnumeratePhysicalDevices(instance.handle(), &count, nullptr);
    if (result == VK_ERROR_INITIALIZATION_FAILED) return {}; // no driver found a device
    check(result, "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> handles(count);
    check(vkEnumeratePhysicalDevices(instance.handle(), &count, handles.data()),
          "vkEnumeratePhysicalDevices");
    std::vector<PhysicalDevice> devices;
    for (uint32_t i = 0; i < count; ++i) devices.push_back(describe(handles[i], i));
    return devices;
}

const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices, const std::string& select) {
    const PhysicalDevice* best = nullptr;
    std::vector<std::string> all;
    for (const PhysicalDevice& device : devices) {
        const DeviceDescription& d = device.description;
        all.push_back(fmt::format("{} {} ({})", d.index, d.name, d.type));
        if (!matches(device, select)) continue;
        const auto order = [](const PhysicalDevice& p) {
            return std::pair(!p.description.missing.empty(), rank(p));
        };
        if (!best || order(device) < order(*best)) best = &device;
    }
    if (!best && all.empty()) fail(ExitCode::NoDevice, "there is no Vulkan device");
    if (!best)
        fail(ExitCode::NoDevice, "no device matches '{}'; there are: {}", select, fmt::join(all, ", "));
    const DeviceDescription& d = best->description;
    if (!d.missing.empty())
        fail(ExitCode::NoDevice, "device {} {} lacks what is required: {}", d.index, d.name,
             fmt::join(d.missing, ", "));
    return *best;
}

std::vector<DeviceDescription> listDevices() {
    const Instance instance(false);
    std::vector<DeviceDescription> descriptions;
    for (const PhysicalDevice& device : physicalDevices(instance)) descriptions.push_back(device.description);
    return descriptions;
}

} // namespace irradia
