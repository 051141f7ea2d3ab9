#include "engine/gpu/reflect.h"
#include "engine/error.h"
#include <algorithm>
#include <memory>
#include <spirv_cross_c.h>

namespace irradia {
namespace {

struct Parsed {
    explicit Parsed(const std::string& kernel, std::span<const uint32_t> spirv)
        : name(kernel) {
        spvc_context made = nullptr;
        if (spvc_context_create(&made) != SPVC_SUCCESS)
            fail(ExitCode::Internal, "kernel {}: SPIRV-Cross", name);
        context.reset(made);
        spvc_parsed_ir ir = nullptr;
        check(spvc_context_parse_spirv(made, spirv.data(), spirv.size(), &ir));
        check(spvc_context_create_compiler(made, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                           &compiler));
        check(spvc_compiler_create_shader_resources(compiler, &resources));
    }

    void check(spvc_result result) const {
        if (result != SPVC_SUCCESS)
            fail(ExitCode::Internal, "kernel {}: {}", name,
                 spvc_context_get_last_error_string(context.get()));
    }

    std::span<const spvc_reflected_resource> list(spvc_resource_type type) const {
        const spvc_reflected_resource* first = nullptr;
        size_t count = 0;
        check(spvc_resources_get_resource_list_for_type(resources, type, &first, &count));
        return {first, count};
    }

    struct Destroy {
        void operator()(spvc_context c) const { spvc_context_destroy(c); }
    };
    std::string name;
    std::unique_ptr<spvc_context_s, Destroy> context;
    spvc_compiler compiler = nullptr;
    spvc_resources resources = nullptr;
};

VkFormat texelFormat(const Parsed& parsed, const spvc_reflected_resource& resource) {
    const spvc_type type = spvc_compiler_get_type_handle(parsed.compiler, resource.type_id);
    if (spvc_type_get_image_dimension(type) == SpvDimBuffer) {
        switch (spvc_type_get_image_storage_format(type)) {
        case SpvImageFormatRgba32ui:
            return VK_FORMAT_R32G32B32A32_UINT;
        case SpvImageFormatRgba32f:
            return VK_FORMAT_R32G32B32A32_SFLOAT;
        case SpvImageFormatRgba16f:
            return VK_FORMAT_R16G16B16A16_SFLOAT;
        case SpvImageFormatRg32ui:
            return VK_FORMAT_R32G32_UINT;
        case SpvImageFormatR32ui:
            return VK_FORMAT_R32_UINT;
        case SpvImageFormatR32i:
            return VK_FORMAT_R32_SINT;
        case SpvImageFormatR32f:
            return VK_FORMAT_R32_SFLOAT;
        default:
            break;
        }
    }
    fail(ExitCode::Internal, "kernel {}: {} is not a texel buffer of a known format", parsed.name,
         resource.name);
}

// Whether a buffer block (all its members) or an image carries the decoration.
bool decorated(const Parsed& parsed, const spvc_reflected_resource& resource, SpvDecoration decoration) {
    if (spvc_compiler_has_decoration(parsed.compiler, resource.id, decoration)) return true;
    const SpvDecoration* decorations = nullptr;
    size_t count = 0;
    if (spvc_compiler_get_buffer_block_decorations(parsed.compiler, resource.id, &decorations, &count) !=
        SPVC_SUCCESS)
        return false;
    return std::find(decorations, decorations + count, decoration) != decorations + count;
}

struct Numbered {
    uint32_t number;
    KernelBinding binding;
};

void append(const Parsed& parsed, spvc_resource_type kind, VkDescriptorType type,
            std::vector<Numbered>& all) {
    for (const spvc_reflected_resource& resource : parsed.list(kind)) {
        if (spvc_compiler_get_decoration(parsed.compiler, resource.id, SpvDecorationDescriptorSet) != 0)
            fail(ExitCode::Internal, "kernel {}: {} is not in set 0", parsed.name, resource.name);
        KernelBinding binding{type, VK_FORMAT_UNDEFINED, true, type != VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                              resource.name};
        if (type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER) {
            binding.format = texelFormat(parsed, resource);
            binding.readable =
                !spvc_compiler_has_decoration(parsed.compiler, resource.id, SpvDecorationNonReadable);
            binding.writable =
                !spvc_compiler_has_decoration(parsed.compiler, resource.id, SpvDecorationNonWritable);
        } else if (type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
            binding.readable = !decorated(parsed, resource, SpvDecorationNonReadable);
            binding.writable = !decorated(parsed, resource, SpvDecorationNonWritable);
        }
        all.push_back(
            {spvc_compiler_get_decoration(parsed.compiler, resource.id, SpvDecorationBinding), binding});
    }
}

std::vector<KernelBinding> bindingsOf(const Parsed& parsed) {
    std::vector<Numbered> all;
    append(parsed, SPVC_RESOURCE_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, all);
    append(parsed, SPVC_RESOURCE_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, all);
    append(parsed, SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, all);
    for (const spvc_resource_type unused :
         {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, SPVC_RESOURCE_TYPE_SEPARATE_IMAGE,
          SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, SPVC_RESOURCE_TYPE_ACCELERATION_STRUCTURE})
        for (const spvc_reflected_resource& resource : parsed.list(unused))
            fail(ExitCode::Internal, "kernel {}: {} is of a kind that no pass can bind", parsed.name,
                 resource.name);

    std::sort(all.begin(), all.end(),
              [](const Numbered& a, const Numbered& b) { return a.number < b.number; });
    std::vector<KernelBinding> bindings;
    for (const Numbered& numbered : all) {
        if (numbered.number != bindings.size())
            fail(ExitCode::Internal,
                 "kernel {}: binding {} ({}) stands where {} should: bindings are 0, 1, 2, ...", parsed.name,
                 numbered.number, numbered.binding.name, bindings.size());
        bindings.push_back(numbered.binding);
    }
    return bindings;
}

} // namespace

Reflection reflect(const std::string& kernel, std::span<const uint32_t> spirv) {
    const Parsed parsed(kernel, spirv);
    Reflection reflection;
    reflection.bindings = bindingsOf(parsed);
    for (const spvc_reflected_resource& block : parsed.list(SPVC_RESOURCE_TYPE_PUSH_CONSTANT)) {
        size_t bytes = 0;
        parsed.check(spvc_compiler_get_declared_struct_size(
            parsed.compiler, spvc_compiler_get_type_handle(parsed.compiler, block.base_type_id), &bytes));
        reflection.pushBytes = static_cast<uint32_t>(bytes);
    }
    const spvc_specialization_constant* constants = nullptr;
    size_t count = 0;
    parsed.check(spvc_compiler_get_specialization_constants(parsed.compiler, &constants, &count));
    for (size_t i = 0; i < count; ++i) reflection.constants.push_back(constants[i].constant_id);
    std::sort(reflection.constants.begin(), reflection.constants.end());
    return reflection;
}

} // namespace irradia
