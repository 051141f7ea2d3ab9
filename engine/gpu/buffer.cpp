#include "engine/gpu/buffer.h"
#include "engine/error.h"
#include "engine/gpu/commands.h"
#include <bit>
#include <cstring>
#include <utility>

namespace irradia {
namespace {

constexpr VkBufferUsageFlags kUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT |
    VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

// Memory::Device is not mapped: it is cleared by the device, once, at creation.
void clear(Device& device, const Buffer& buffer) {
    OneTimeCommands commands(device);
    vkCmdFillBuffer(commands.handle(), buffer.handle(), 0, VK_WHOLE_SIZE, 0);
    commands.submitAndWait("clearing buffer " + buffer.name());
}

} // namespace

Buffer::Buffer(Device& device, std::string name, uint64_t bytes, Memory memory)
    : device_(&device)
    , name_(std::move(name))
    , bytes_(bytes) {
    if (bytes == 0) fail(ExitCode::Internal, "buffer {}: of no bytes", name_);
    try {
        VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
        info.size = (bytes + 15) / 16 * 16; // a whole number of quads, so that the last one can be viewed
        info.usage = kUsage;
        if (device.features().bufferDeviceAddress) info.usage |= VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
        info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
        check(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_), "buffer " + name_);
        memory_ = device.allocate(buffer_, memory == Memory::Host, name_, allocated_);
        check(vkBindBufferMemory(device.handle(), buffer_, memory_, 0), "buffer " + name_);
        device.label(VK_OBJECT_TYPE_BUFFER, std::bit_cast<uint64_t>(buffer_), name_);
        if (memory == Memory::Host) {
            void* mapped = nullptr;
            check(vkMapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped), "buffer " + name_);
            mapped_ = static_cast<std::byte*>(mapped);
            std::memset(mapped_, 0, info.size);
        } else {
            clear(device, *this);
        }
    } catch (...) {
        destroy();
        throw;
    }
}

Buffer::~Buffer() {
    destroy();
}

void Buffer::destroy() {
    if (!device_ || device_->abandoned()) return;
    for (const auto& [key, view] : views_) vkDestroyBufferView(device_->handle(), view, nullptr);
    if (buffer_ != VK_NULL_HANDLE) vkDestroyBuffer(device_->handle(), buffer_, nullptr);
    if (memory_ != VK_NULL_HANDLE) device_->release(memory_, allocated_);
    device_ = nullptr;
}

Buffer::Buffer(Buffer&& other) noexcept {
    *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    if (this == &other) return *this;
    destroy();
    device_ = std::exchange(other.device_, nullptr);
    name_ = std::move(other.name_);
    bytes_ = std::exchange(other.bytes_, 0);
    allocated_ = std::exchange(other.allocated_, 0);
    buffer_ = std::exchange(other.buffer_, VK_NULL_HANDLE);
    memory_ = std::exchange(other.memory_, VK_NULL_HANDLE);
    mapped_ = std::exchange(other.mapped_, nullptr);
    views_ = std::exchange(other.views_, {});
    return *this;
}

std::span<std::byte> Buffer::mapped() const {
    if (!mapped_) fail(ExitCode::Internal, "buffer {}: is not mapped", name_);
    return {mapped_, bytes_};
}

uint64_t Buffer::address() const {
    if (!device_->features().bufferDeviceAddress) return 0;
    VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
    info.buffer = buffer_;
    return vkGetBufferDeviceAddress(device_->handle(), &info);
}

VkBufferView Buffer::texelView(VkFormat format, uint64_t offset, uint64_t range) const {
    VkBufferView& view = views_[{format, offset, range}];
    if (view != VK_NULL_HANDLE) return view;
    VkBufferViewCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
    info.buffer = buffer_;
    info.format = format;
    info.offset = offset;
    info.range = range;
    check(vkCreateBufferView(device_->handle(), &info, nullptr, &view), "texel view of buffer " + name_);
    return view;
}

} // namespace irradia
