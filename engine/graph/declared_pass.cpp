#include "engine/graph/declared_pass.h"
#include "engine/error.h"
#include <bit>

namespace irradia {
namespace {

const char* accessName(bool read, bool write) {
    return read ? (write ? "readWrite" : "read") : "write";
}

uint32_t texelBytes(VkFormat format) {
    switch (format) {
    case VK_FORMAT_R32G32B32A32_UINT:
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        return 16;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
    case VK_FORMAT_R32G32_UINT:
        return 8;
    default:
        return 4;
    }
}

// The largest range that can be bound, and what its offset must be a multiple of.
struct RangeLimit {
    uint64_t bytes = 0;
    uint64_t alignment = 1;
};

RangeLimit limitOf(const KernelBinding& binding, const VkPhysicalDeviceLimits& limits) {
    switch (binding.type) {
    case VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER:
        return {uint64_t{limits.maxTexelBufferElements} * texelBytes(binding.format),
                limits.minTexelBufferOffsetAlignment};
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
        return {limits.maxUniformBufferRange, limits.minUniformBufferOffsetAlignment};
    default:
        return {limits.maxStorageBufferRange, limits.minStorageBufferOffsetAlignment};
    }
}

void checkRange(const DeclaredPass& pass, const KernelBinding& wanted, const BufferRange& range,
                const VkPhysicalDeviceLimits& limits) {
    const RangeLimit limit = limitOf(wanted, limits);
    const std::string& buffer = range.buffer->name();
    if (range.bytes == 0 || range.offset > range.buffer->bytes() ||
        range.bytes > range.buffer->bytes() - range.offset)
        fail(ExitCode::Internal, "pass {}: {}: {} bytes at {} are not a range of buffer {} ({} bytes)",
             pass.name, wanted.name, range.bytes, range.offset, buffer, range.buffer->bytes());
    if (range.bytes > limit.bytes)
        fail(ExitCode::Internal, "pass {}: {}: {} bytes of buffer {} are more than one binding holds ({})",
             pass.name, wanted.name, range.bytes, buffer, limit.bytes);
    if (range.offset % limit.alignment != 0)
        fail(ExitCode::Internal, "pass {}: {}: offset {} in buffer {} is not a multiple of {}", pass.name,
             wanted.name, range.offset, buffer, limit.alignment);
    if (wanted.type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER &&
        range.bytes % texelBytes(wanted.format) != 0)
        fail(ExitCode::Internal, "pass {}: {}: {} bytes of buffer {} are not whole texels of {}", pass.name,
             wanted.name, range.bytes, buffer, texelBytes(wanted.format));
}

AccessKind kindOf(const KernelBinding& binding) {
    switch (binding.type) {
    case VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER:
        return AccessKind::Texel;
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
        return AccessKind::Uniform;
    default:
        return AccessKind::Storage;
    }
}

Access access(const BufferRange& range, AccessKind kind, bool read, bool write) {
    return {std::bit_cast<uint64_t>(range.buffer->handle()),
            range.offset,
            range.bytes,
            kind,
            read,
            write,
            range.buffer->name()};
}

} // namespace

void checkAgainstKernel(const DeclaredPass& pass, const Device& device) {
    const std::vector<KernelBinding>& wanted = pass.kernel->bindings();
    if (pass.bindings.size() != wanted.size())
        fail(ExitCode::Internal, "pass {}: {} buffers are bound, kernel {} has {} bindings", pass.name,
             pass.bindings.size(), pass.kernel->name(), wanted.size());
    for (size_t i = 0; i < wanted.size(); ++i) {
        const PassBinding& binding = pass.bindings[i];
        if (binding.read != wanted[i].readable || binding.write != wanted[i].writable)
            fail(ExitCode::Internal, "pass {}: binding {} ({}) is bound for {}, the kernel declares {}",
                 pass.name, i, wanted[i].name, accessName(binding.read, binding.write),
                 accessName(wanted[i].readable, wanted[i].writable));
        checkRange(pass, wanted[i], binding.range, device.limits());
    }
    if (pass.pushBytes != pass.kernel->pushBytes())
        fail(ExitCode::Internal, "pass {}: {} bytes of push constants are given, kernel {} declares {}",
             pass.name, pass.pushBytes, pass.kernel->name(), pass.kernel->pushBytes());
}

ScheduledPass accessesOf(const DeclaredPass& pass) {
    ScheduledPass scheduled{pass.name, {}};
    for (size_t i = 0; i < pass.bindings.size(); ++i)
        scheduled.accesses.push_back(access(pass.bindings[i].range, kindOf(pass.kernel->bindings()[i]),
                                            pass.bindings[i].read, pass.bindings[i].write));
    if (pass.argument)
        scheduled.accesses.push_back(
            access(*pass.argument, pass.kernel ? AccessKind::Indirect : AccessKind::Transfer, true, false));
    if (pass.target) scheduled.accesses.push_back(access(*pass.target, AccessKind::Transfer, false, true));
    return scheduled;
}

} // namespace irradia
