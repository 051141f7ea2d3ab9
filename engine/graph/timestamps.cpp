#include "engine/graph/timestamps.h"

namespace irradia {

Timestamps::~Timestamps() {
    if (!device_.abandoned()) vkDestroyQueryPool(device_.handle(), pool_, nullptr);
}

void Timestamps::begin(VkCommandBuffer commands, uint32_t passes) {
    passes_ = 0;
    if (device_.timestampPeriodNs() <= 0) return;
    passes_ = passes;
    written_ = 0;
    if (room_ < passes + 1) {
        vkDestroyQueryPool(device_.handle(), pool_, nullptr);
        pool_ = VK_NULL_HANDLE;
        room_ = 2 * (passes + 1);
        VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
        info.queryType = VK_QUERY_TYPE_TIMESTAMP;
        info.queryCount = room_;
        check(vkCreateQueryPool(device_.handle(), &info, nullptr, &pool_), "vkCreateQueryPool");
    }
    vkCmdResetQueryPool(commands, pool_, 0, passes + 1);
    passDone(commands);
}

void Timestamps::passDone(VkCommandBuffer commands) {
    if (passes_ == 0) return;
    // lavapipe finishes a command before it takes up the next, so that its clock is right at any stage, and
    // waits for its threads at each but the first (measured: 5 microseconds a pass instead of 10).
    const VkPipelineStageFlagBits stage =
        device_.isCpu() ? VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT : VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT;
    vkCmdWriteTimestamp(commands, stage, pool_, written_++);
}

std::vector<double> Timestamps::milliseconds() const {
    if (passes_ == 0) return {};
    std::vector<uint64_t> ticks(passes_ + 1);
    check(vkGetQueryPoolResults(device_.handle(), pool_, 0, passes_ + 1, ticks.size() * sizeof(uint64_t),
                                ticks.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT),
          "vkGetQueryPoolResults");
    std::vector<double> times(passes_);
    const double milliseconds = static_cast<double>(device_.timestampPeriodNs()) * 1e-6;
    // A counter that wrapped around counts as no time.
    for (uint32_t i = 0; i < passes_; ++i)
        times[i] =
            ticks[i + 1] > ticks[i] ? static_cast<double>(ticks[i + 1] - ticks[i]) * milliseconds : 0.0;
    return times;
}

} // namespace irradia
