#include "engine/graph/descriptor_sets.h"
#include <algorithm>

namespace irradia {

DescriptorSets::~DescriptorSets() {
    if (device_.abandoned()) return;
    for (const auto& [types, group] : groups_) {
        for (VkDescriptorPool pool : group.pools) vkDestroyDescriptorPool(device_.handle(), pool, nullptr);
        vkDestroyDescriptorSetLayout(device_.handle(), group.layout, nullptr);
    }
}

void DescriptorSets::reset() {
    for (auto& [types, group] : groups_) group.used = 0;
}

VkDescriptorSet DescriptorSets::take(const DeclaredPass& pass) {
    types_.clear();
    for (const KernelBinding& binding : pass.kernel->bindings()) types_.push_back(binding.type);
    Group& group = groups_[types_];
    if (group.used == group.sets.size()) grow(group, pass);
    return group.sets[group.used++];
}

// Twice as many sets as there are.
void DescriptorSets::grow(Group& group, const DeclaredPass& pass) {
    const std::string what = "descriptors of pass " + pass.name;
    if (group.layout == VK_NULL_HANDLE) group.layout = makeSetLayout(device_, what, pass.kernel->bindings());
    const auto more = static_cast<uint32_t>(std::max<size_t>(group.sets.size(), 1));
    std::vector<VkDescriptorPoolSize> sizes;
    for (const VkDescriptorType type : types_) sizes.push_back({type, more});
    if (sizes.empty()) sizes.push_back({VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1}); // a pool needs some size
    VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    poolInfo.maxSets = more;
    poolInfo.poolSizeCount = static_cast<uint32_t>(sizes.size());
    poolInfo.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &pool), what);
    group.pools.push_back(pool);

    const std::vector<VkDescriptorSetLayout> layouts(more, group.layout);
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool;
    info.descriptorSetCount = more;
    info.pSetLayouts = layouts.data();
    group.sets.resize(group.sets.size() + more);
    check(vkAllocateDescriptorSets(device_.handle(), &info, group.sets.data() + group.used), what);
}

VkDescriptorSet DescriptorSets::make(const DeclaredPass& pass) {
    const VkDescriptorSet set = take(pass);
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
