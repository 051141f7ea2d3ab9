#include "engine/graph/barrier.h"
#include <array>

namespace irradia {
namespace {

struct Scope {
    AccessKind kind;
    VkPipelineStageFlags stage;
    VkAccessFlags read;
    VkAccessFlags write;
};

constexpr std::array kScopes{
    Scope{AccessKind::Storage, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT,
          VK_ACCESS_SHADER_WRITE_BIT},
    Scope{AccessKind::Texel, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT,
          VK_ACCESS_SHADER_WRITE_BIT},
    Scope{AccessKind::Uniform, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_UNIFORM_READ_BIT, 0},
    Scope{AccessKind::Indirect, VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, VK_ACCESS_INDIRECT_COMMAND_READ_BIT, 0},
    Scope{AccessKind::Transfer, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT,
          VK_ACCESS_TRANSFER_WRITE_BIT},
    Scope{AccessKind::Host, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT, VK_ACCESS_HOST_WRITE_BIT},
};

} // namespace

void emitBarrier(VkCommandBuffer commands, const Barrier& barrier) {
    VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    VkPipelineStageFlags before = 0;
    VkPipelineStageFlags after = 0;
    for (const Scope& scope : kScopes) {
        const AccessKinds kind = kindBit(scope.kind);
        if ((barrier.writesBefore | barrier.readsBefore) & kind) before |= scope.stage;
        if (barrier.writesBefore & kind) memory.srcAccessMask |= scope.write;
        if (barrier.after & kind) {
            after |= scope.stage;
            memory.dstAccessMask |= scope.read | scope.write;
        }
    }
    vkCmdPipelineBarrier(commands, before, after, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

} // namespace irradia
