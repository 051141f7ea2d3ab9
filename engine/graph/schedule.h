// From what passes access to the barriers between them. Pure: no Vulkan, no device.
//
// Hazards are keyed on buffer and byte range. A read after a write, a write after a read and a write after a
// write of overlapping ranges each ask for one global memory barrier before the later pass. A barrier orders
// everything before it, so later hazards against earlier passes are already answered: its `after` holds every
// kind of access that passes make on the device. Only the host's accesses, which cost a flush, are waited for
// where they occur. No hazard emits none.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace irradia {

enum class AccessKind : uint8_t { Storage, Texel, Uniform, Indirect, Transfer, Host };

struct Access {
    uint64_t resource = 0; // identity of the buffer
    uint64_t offset = 0;
    uint64_t bytes = 0;
    AccessKind kind = AccessKind::Storage;
    bool read = false;
    bool write = false;
    std::string_view name = {}; // of the buffer, for messages
};

// Sets of access kinds, one bit per AccessKind.
using AccessKinds = uint32_t;
constexpr AccessKinds kindBit(AccessKind kind) {
    return 1u << static_cast<uint32_t>(kind);
}

// What one global memory barrier before a pass must order; all zero = no barrier.
struct Barrier {
    AccessKinds writesBefore = 0; // kinds of earlier writes to make available
    AccessKinds readsBefore = 0;  // kinds of earlier reads that must have finished (execution only)
    AccessKinds after = 0;        // kinds of the accesses that wait
    bool needed() const { return after != 0; }
};

struct ScheduledPass {
    std::string name;
    std::vector<Access> accesses;
};

// One Barrier per pass, to be emitted before it. Throws Error(Internal), naming pass and resource, when a
// pass writes a range through one access and reads an overlapping one as texels through another.
std::vector<Barrier> schedule(std::span<const ScheduledPass> passes);

} // namespace irradia
