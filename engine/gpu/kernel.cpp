#include "engine/gpu/kernel.h"
#include "engine/error.h"
#include "engine/gpu/reflect.h"
#include <algorithm>
#include <bit>
#include <utility>

namespace irradia {
namespace {

constexpr uint32_t kWorkgroupSizeId = 0;
constexpr uint32_t kSubgroupSizeId = 1;
constexpr uint32_t kCpuWorkgroup = 32;
constexpr uint32_t kGpuWorkgroup = 128;

uint32_t chooseWorkgroup(const Device& device, const std::string& name, const KernelOptions& options) {
    const bool pinned = options.pinSubgroup && device.canPinSubgroupSize();
    const uint32_t subgroup = options.pinSubgroup ? device.subgroupSize() : device.nativeSubgroupSize();
    if (options.workgroupSize == 0) {
        const uint32_t size = device.isCpu() ? kCpuWorkgroup : kGpuWorkgroup;
        return (size + subgroup - 1) / subgroup * subgroup;
    }
    const VkPhysicalDeviceLimits& limits = device.limits();
    const uint32_t most = std::min({limits.maxComputeWorkGroupInvocations, limits.maxComputeWorkGroupSize[0],
                                    pinned ? device.maxPinnedWorkgroup() : UINT32_MAX});
    if (options.workgroupSize > most)
        fail(ExitCode::Internal, "kernel {}: workgroups of {} are more than the device's {}{}", name,
             options.workgroupSize, most, pinned ? fmt::format(" with subgroups of {}", subgroup) : "");
    return options.workgroupSize;
}

void checkCounts(const Device& device, const std::string& name, const std::vector<KernelBinding>& bindings) {
    const auto count = [&](VkDescriptorType type) {
        return std::count_if(bindings.begin(), bindings.end(), [&](const auto& b) { return b.type == type; });
    };
    const VkPhysicalDeviceLimits& limits = device.limits();
    if (count(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) > limits.maxPerStageDescriptorStorageBuffers ||
        count(VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER) > limits.maxPerStageDescriptorStorageImages)
        fail(ExitCode::NoDevice,
             "kernel {}: binds more buffers than the device allows ({} storage, {} texel)", name,
             limits.maxPerStageDescriptorStorageBuffers, limits.maxPerStageDescriptorStorageImages);
}

VkPipelineLayout makeLayout(const Device& device, const std::string& name, VkDescriptorSetLayout set,
                            uint32_t pushBytes) {
    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, pushBytes};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &set;
    info.pushConstantRangeCount = pushBytes > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout), "kernel " + name);
    return layout;
}

// The values behind VkSpecializationInfo; ids the shader does not have are refused.
struct Constants {
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<uint32_t> values;

    void add(uint32_t id, uint32_t value) {
        entries.push_back({id, static_cast<uint32_t>(values.size() * sizeof(uint32_t)), sizeof(uint32_t)});
        values.push_back(value);
    }
    VkSpecializationInfo info() const {
        return {static_cast<uint32_t>(entries.size()), entries.data(), values.size() * sizeof(uint32_t),
                values.data()};
    }
};

Constants specialise(const std::string& name, const Reflection& reflection,
                     const std::vector<Specialisation>& given, uint32_t workgroup, uint32_t subgroup) {
    Constants constants;
    constants.add(kWorkgroupSizeId, workgroup);
    constants.add(kSubgroupSizeId, subgroup);
    for (const Specialisation& constant : given) {
        if (constant.id <= kSubgroupSizeId)
            fail(ExitCode::Internal, "kernel {}: constant {} is set by the kernel itself", name, constant.id);
        if (!std::binary_search(reflection.constants.begin(), reflection.constants.end(), constant.id))
            fail(ExitCode::Internal, "kernel {}: has no specialisation constant {}", name, constant.id);
        constants.add(constant.id, constant.value);
    }
    return constants;
}

VkPipeline makePipeline(const Device& device, const std::string& name, std::span<const uint32_t> spirv,
                        VkPipelineLayout layout, const Constants& constants, bool pin) {
    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    moduleInfo.codeSize = spirv.size_bytes();
    moduleInfo.pCode = spirv.data();
    VkShaderModule shader = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.handle(), &moduleInfo, nullptr, &shader), "kernel " + name);

    const VkSpecializationInfo specialisation = constants.info();
    VkPipelineShaderStageRequiredSubgroupSizeCreateInfo size{
        VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO};
    size.requiredSubgroupSize = device.subgroupSize();
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialisation;
    info.layout = layout;
    if (pin) {
        info.stage.pNext = &size;
        if (constants.values[kWorkgroupSizeId] % device.subgroupSize() == 0)
            info.stage.flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
    }
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result =
        vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
    vkDestroyShaderModule(device.handle(), shader, nullptr);
    check(result, "kernel " + name);
    return pipeline;
}

} // namespace

VkDescriptorSetLayout makeSetLayout(const Device& device, const std::string& what,
                                    const std::vector<KernelBinding>& bindings) {
    std::vector<VkDescriptorSetLayoutBinding> slots;
    for (const KernelBinding& binding : bindings)
        slots.push_back(
            {static_cast<uint32_t>(slots.size()), binding.type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = static_cast<uint32_t>(slots.size());
    info.pBindings = slots.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout), what);
    return layout;
}

Kernel::Kernel(Device& device, const KernelSource& source, const KernelOptions& options)
    : device_(&device)
    , name_(source.name) {
    const std::span<const uint32_t> spirv = device.texelQuads() ? source.texel : source.storage;
    Reflection reflection = reflect(name_, spirv);
    const uint32_t subgroup = options.pinSubgroup ? device.subgroupSize() : device.nativeSubgroupSize();
    workgroupSize_ = chooseWorkgroup(device, name_, options);
    pushBytes_ = reflection.pushBytes;
    checkCounts(device, name_, reflection.bindings);
    const Constants constants = specialise(name_, reflection, options.constants, workgroupSize_, subgroup);
    bindings_ = std::move(reflection.bindings);
    try {
        setLayout_ = makeSetLayout(device, "kernel " + name_, bindings_);
        layout_ = makeLayout(device, name_, setLayout_, pushBytes_);
        pipeline_ = makePipeline(device, name_, spirv, layout_, constants,
                                 options.pinSubgroup && device.canPinSubgroupSize());
    } catch (...) {
        destroy();
        throw;
    }
    device.label(VK_OBJECT_TYPE_PIPELINE, std::bit_cast<uint64_t>(pipeline_), name_);
}

Kernel::~Kernel() {
    destroy();
}

void Kernel::destroy() {
    if (!device_ || device_->abandoned()) return;
    vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
    vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
    vkDestroyDescriptorSetLayout(device_->handle(), setLayout_, nullptr);
    device_ = nullptr;
}

Kernel::Kernel(Kernel&& other) noexcept {
    *this = std::move(other);
}

Kernel& Kernel::operator=(Kernel&& other) noexcept {
    if (this == &other) return *this;
    destroy();
    device_ = std::exchange(other.device_, nullptr);
    name_ = std::move(other.name_);
    workgroupSize_ = other.workgroupSize_;
    pushBytes_ = other.pushBytes_;
    bindings_ = std::move(other.bindings_);
    setLayout_ = std::exchange(other.setLayout_, VK_NULL_HANDLE);
    layout_ = std::exchange(other.layout_, VK_NULL_HANDLE);
    pipeline_ = std::exchange(other.pipeline_, VK_NULL_HANDLE);
    return *this;
}

} // namespace irradia
