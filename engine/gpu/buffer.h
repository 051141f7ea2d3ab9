// A GPU buffer, usable as storage, texel, uniform, indirect and transfer memory alike.
#pragma once

#include "engine/gpu/device.h"
#include <algorithm>
#include <cstddef>
#include <glm/vec2.hpp>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace irradia {

enum class Memory {
    Device,
    Host, // mapped and coherent: read and written by mapped() between graph executions
};

// Move-only; owns its memory and its texel views. Content is zero at creation.
class Buffer {
public:
    Buffer() = default;
    Buffer(Device& device, std::string name, uint64_t bytes, Memory memory = Memory::Device);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    const std::string& name() const { return name_; }
    uint64_t bytes() const { return bytes_; }
    VkBuffer handle() const { return buffer_; }
    explicit operator bool() const { return buffer_ != VK_NULL_HANDLE; }
    bool isMapped() const { return mapped_ != nullptr; } // Memory::Host
    std::span<std::byte> mapped() const;                 // Memory::Host only

    // Of its first byte; 0 where the device has no bufferDeviceAddress.
    uint64_t address() const;

    // A view of [offset, offset + range) as texels of `format`; made once, owned by the buffer.
    VkBufferView texelView(VkFormat format, uint64_t offset, uint64_t range) const;

private:
    void destroy();
    Device* device_ = nullptr;
    std::string name_;
    uint64_t bytes_ = 0;
    uint64_t allocated_ = 0;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::byte* mapped_ = nullptr;
    mutable std::map<std::tuple<VkFormat, uint64_t, uint64_t>, VkBufferView> views_;
};

// A part of a buffer; what passes bind. Converts from a whole Buffer.
struct BufferRange {
    const Buffer* buffer = nullptr;
    uint64_t offset = 0;
    uint64_t bytes = 0;

    BufferRange(const Buffer& whole)
        : buffer(&whole)
        , bytes(whole.bytes()) {}
    BufferRange(const Buffer& b, uint64_t at, uint64_t size)
        : buffer(&b)
        , offset(at)
        , bytes(size) {}

    // Low and high word of the first byte's address, as kernels take it; of use where the device has
    // addresses.
    glm::uvec2 address() const {
        const uint64_t first = buffer->address() + offset;
        return {static_cast<uint32_t>(first), static_cast<uint32_t>(first >> 32)};
    }
};

// Synchronous copies through a staging buffer; the ranges must lie inside the buffer.
void uploadBytes(Device& device, const Buffer& to, std::span<const std::byte> from, uint64_t offset = 0);
void downloadBytes(Device& device, const Buffer& from, std::span<std::byte> to, uint64_t offset = 0);

template <typename T>
void upload(Device& device, const Buffer& to, std::span<const T> from, uint64_t offset = 0) {
    static_assert(std::is_trivially_copyable_v<T>);
    uploadBytes(device, to, std::as_bytes(from), offset);
}

template <typename T>
std::vector<T> download(Device& device, const Buffer& from, size_t count, uint64_t offset = 0) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(count);
    downloadBytes(device, from, std::as_writable_bytes(std::span<T>(values)), offset);
    return values;
}

// A device buffer holding `values` (at least one element's size, so that it can always be bound).
template <typename T>
Buffer makeBuffer(Device& device, const std::string& name, const std::vector<T>& values) {
    Buffer buffer(device, name, std::max<size_t>(values.size(), 1) * sizeof(T));
    if (!values.empty()) upload<T>(device, buffer, values);
    return buffer;
}

} // namespace irradia
