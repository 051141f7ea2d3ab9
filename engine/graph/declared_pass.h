// A pass as the frame graph keeps it between its declaration and its execution.
#pragma once

#include "engine/graph/frame_graph.h"
#include <array>
#include <optional>

namespace irradia {

struct DeclaredPass {
    enum class Command { None, Dispatch, DispatchIndirect, Fill, Copy, Update };

    std::string name;
    const Kernel* kernel = nullptr; // none for fills, copies and updates
    std::vector<PassBinding> bindings;
    std::array<std::byte, 128> push{};
    uint32_t pushBytes = 0;
    Command command = Command::None;
    uint32_t groups = 0;                 // Dispatch
    std::optional<BufferRange> argument; // DispatchIndirect: group counts; Copy: the source
    std::optional<BufferRange> target;   // Fill, Copy, Update
    uint32_t value = 0;                  // Fill
    std::vector<std::byte> content;      // Update
    bool cutBefore = false;
    uint32_t run = 0; // passes of the same name before it in this execution
};

// Throws Error(Internal) naming pass and binding where the bindings or push constants are not the kernel's.
void checkAgainstKernel(const DeclaredPass& pass, const Device& device);

// What the pass accesses, for the schedule.
ScheduledPass accessesOf(const DeclaredPass& pass);

} // namespace irradia
