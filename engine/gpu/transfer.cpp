#include "engine/error.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/commands.h"
#include <algorithm>
#include <cstring>

namespace irradia {
namespace {

// Large copies go through a staging buffer in pieces, so that they need little memory of their own.
constexpr uint64_t kStagingBytes = 32ull << 20;

void checkRange(const Buffer& buffer, uint64_t offset, uint64_t bytes, const char* verb) {
    if (offset > buffer.bytes() || bytes > buffer.bytes() - offset)
        fail(ExitCode::Internal, "buffer {}: {} of {} bytes at {} in {}", buffer.name(), verb, bytes, offset,
             buffer.bytes());
}

void copyAndWait(Device& device, VkBuffer from, VkBuffer to, const VkBufferCopy& region,
                 const std::string& what) {
    OneTimeCommands commands(device);
    vkCmdCopyBuffer(commands.handle(), from, to, 1, &region);
    commands.submitAndWait(what);
}

} // namespace

void uploadBytes(Device& device, const Buffer& to, std::span<const std::byte> from, uint64_t offset) {
    checkRange(to, offset, from.size(), "upload");
    if (from.empty()) return;
    const Buffer staging(device, "staging for " + to.name(), std::min<uint64_t>(from.size(), kStagingBytes),
                         Memory::Host);
    for (uint64_t at = 0; at < from.size(); at += staging.bytes()) {
        const uint64_t bytes = std::min<uint64_t>(staging.bytes(), from.size() - at);
        std::memcpy(staging.mapped().data(), from.data() + at, bytes);
        copyAndWait(device, staging.handle(), to.handle(), {0, offset + at, bytes},
                    "upload to buffer " + to.name());
    }
}

void downloadBytes(Device& device, const Buffer& from, std::span<std::byte> to, uint64_t offset) {
    checkRange(from, offset, to.size(), "download");
    if (to.empty()) return;
    const Buffer staging(device, "staging for " + from.name(), std::min<uint64_t>(to.size(), kStagingBytes),
                         Memory::Host);
    for (uint64_t at = 0; at < to.size(); at += staging.bytes()) {
        const uint64_t bytes = std::min<uint64_t>(staging.bytes(), to.size() - at);
        copyAndWait(device, from.handle(), staging.handle(), {offset + at, 0, bytes},
                    "download of buffer " + from.name());
        std::memcpy(to.data() + at, staging.mapped().data(), bytes);
    }
}

} // namespace irradia
