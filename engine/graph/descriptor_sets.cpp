#include "engine/graph/descriptor_sets.h"
#include <array>

namespace irradia {

DescriptorSets::~DescriptorSets() {
    if (!device_.abandoned()) vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
}

bool DescriptorSets::Counts::holds(const Counts& other) const {
    return sets >= other.sets && storage >= other.storage && texel >= other.texel && uniform >= other.uniform;
}

void DescriptorSets::create(const Counts& counts) {
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    pool_ = VK_NULL_HANDLE;
    // Twice what is needed now, so that frames that differ a little do not make a new pool each.
    room_ = {2 * counts.sets, 2 * counts.storage + 1, 2 * counts.texel + 1, 2 * counts.uniform + 1};
    const std::array sizes{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, room_.storage},
                           VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, room_.texel},
                           VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, room_.uniform}};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = room_.sets;
    info.poolSizeCount = sizes.size();
    info.pPoolSizes = sizes.data();
    check(vkCreateDescriptorPool(device_.handle(), &info, nullptr, &pool_), "vkCreateDescriptorPool");
}

void DescriptorSets::reset(std::span<const PassRecord> passes) {
    Counts counts;
    for (const PassRecord& pass : passes) {
        if (!pass.kernel) continue;
        ++counts.sets;
        for (const KernelBinding& binding : pass.kernel->bindings()) {
            counts.storage += binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            counts.texel += binding.type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
            counts.uniform += binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        }
    }
    if (!room_.holds(counts)) {
        create(counts);
    } else if (pool_ != VK_NULL_HANDLE) {
        check(vkResetDescriptorPool(device_.handle(), pool_, 0), "vkResetDescriptorPool");
    }
}

VkDescriptorSet DescriptorSets::make(const PassRecord& pass) {
    VkDescriptorSetLayout layout = pass.kernel->setLayout();
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool_;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vkAllocateDescriptorSets(device_.handle(), &info, &set), "descriptors of pass " + pass.name);

    const size_t count = pass.bindings.size();
    writes_.assign(count, {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET});
    buffers_.assign(count, {});
    views_.assign(count, VK_NULL_HANDLE);
    for (size_t i = 0; i < count; ++i) {
        const BufferRange& range = pass.bindings[i].range;
        const KernelBinding& binding = pass.kernel->bindings()[i];
        writes_[i].dstSet = set;
        writes_[i].dstBinding = static_cast<uint32_t>(i);
        writes_[i].descriptorCount = 1;
        writes_[i].descriptorType = binding.type;
        if (binding.type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER) {
            views_[i] = range.buffer->texelView(binding.format, range.offset, range.bytes);
            writes_[i].pTexelBufferView = &views_[i];
        } else {
            buffers_[i] = {range.buffer->handle(), range.offset, range.bytes};
            writes_[i].pBufferInfo = &buffers_[i];
        }
    }
    vkUpdateDescriptorSets(device_.handle(), static_cast<uint32_t>(count), writes_.data(), 0, nullptr);
    return set;
}

} // namespace irradia
