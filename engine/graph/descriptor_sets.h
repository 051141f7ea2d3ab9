// Descriptor sets of one execution: made for each pass, all given back at the next.
#pragma once

#include "engine/graph/pass_record.h"

namespace irradia {

class DescriptorSets {
public:
    explicit DescriptorSets(const Device& device)
        : device_(device) {}
    ~DescriptorSets();
    DescriptorSets(const DescriptorSets&) = delete;
    DescriptorSets& operator=(const DescriptorSets&) = delete;

    // Gives all sets back and makes room for those of `passes`.
    void reset(std::span<const PassRecord> passes);
    VkDescriptorSet make(const PassRecord& pass);

private:
    struct Counts {
        uint32_t sets = 0;
        uint32_t storage = 0;
        uint32_t texel = 0;
        uint32_t uniform = 0;
        bool holds(const Counts& other) const;
    };
    void create(const Counts& counts);

    const Device& device_;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    Counts room_;
    // Reused from pass to pass.
    std::vector<VkWriteDescriptorSet> writes_;
    std::vector<VkDescriptorBufferInfo> buffers_;
    std::vector<VkBufferView> views_;
};

} // namespace irradia
