// A compute shader made into a pipeline: its bindings are read from the SPIR-V, its constants specialised.
#pragma once

#include "engine/gpu/device.h"
#include <span>
#include <string>
#include <vector>

namespace irradia {

// SPIR-V embedded at build time: one GLSL file, compiled with quads as texel views and as storage buffers.
struct KernelSource {
    const char* name; // the pass's name: file name without extension
    std::span<const uint32_t> texel;
    std::span<const uint32_t> storage;
};

// layout(constant_id = id). Ids 0 and 1 (workgroup size, subgroup size) are set by Kernel itself.
struct Specialisation {
    uint32_t id;
    uint32_t value;
};

// One binding of set 0, in order of its number 0, 1, 2, ...
struct KernelBinding {
    VkDescriptorType type;                 // storage buffer, storage texel buffer or uniform buffer
    VkFormat format = VK_FORMAT_UNDEFINED; // of a texel view
    bool readable = true;                  // not declared writeonly
    bool writable = true;                  // not declared readonly
    std::string name;
};

// One binding after the other, from 0 on. To be destroyed by the caller; `what` names it in errors.
VkDescriptorSetLayout makeSetLayout(const Device& device, const std::string& what,
                                    const std::vector<KernelBinding>& bindings);

struct KernelOptions {
    std::vector<Specialisation> constants;
    uint32_t workgroupSize =
        0;                   // 0 = the device class's default (CPU 32, GPU 128), a multiple of the subgroup
    bool pinSubgroup = true; // require Device::subgroupSize()
};

class Kernel {
public:
    Kernel() = default;
    Kernel(Device& device, const KernelSource& source, const KernelOptions& options = {});
    ~Kernel();
    Kernel(Kernel&& other) noexcept;
    Kernel& operator=(Kernel&& other) noexcept;

    const std::string& name() const { return name_; }
    uint32_t workgroupSize() const { return workgroupSize_; }
    uint32_t pushBytes() const { return pushBytes_; }
    const std::vector<KernelBinding>& bindings() const { return bindings_; }
    VkPipeline pipeline() const { return pipeline_; }
    VkPipelineLayout layout() const { return layout_; }

private:
    void destroy();
    Device* device_ = nullptr;
    std::string name_;
    uint32_t workgroupSize_ = 0;
    uint32_t pushBytes_ = 0;
    std::vector<KernelBinding> bindings_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

} // namespace irradia
