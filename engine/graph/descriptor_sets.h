// The descriptor sets of a frame graph, one for each pass of an execution. They are kept from one to the
// next, and written again: lavapipe maps memory for each that it makes.
#pragma once

#include "engine/graph/declared_pass.h"
#include <map>

namespace irradia {

class DescriptorSets {
public:
    explicit DescriptorSets(const Device& device)
        : device_(device) {}
    ~DescriptorSets();
    DescriptorSets(const DescriptorSets&) = delete;
    DescriptorSets& operator=(const DescriptorSets&) = delete;

    // An execution begins: none of the sets is in use.
    void reset();
    VkDescriptorSet make(const DeclaredPass& pass);

private:
    // Sets of one layout, which is compatible with those of all kernels that bind the same types in the same
    // order.
    struct Group {
        VkDescriptorSetLayout layout = VK_NULL_HANDLE;
        std::vector<VkDescriptorPool> pools;
        std::vector<VkDescriptorSet> sets;
        size_t used = 0;
    };
    using Types = std::vector<VkDescriptorType>;

    VkDescriptorSet take(const DeclaredPass& pass);
    void grow(Group& group, const DeclaredPass& pass);

    const Device& device_;
    std::map<Types, Group> groups_;
    // Reused from pass to pass.
    Types types_;
    std::vector<VkWriteDescriptorSet> writes_;
    std::vector<VkDescriptorBufferInfo> buffers_;
    std::vector<VkBufferView> views_;
};

} // namespace irradia
