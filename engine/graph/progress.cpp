#include "engine/graph/progress.h"
#include <cstring>

namespace irradia {

void Progress::begin(uint32_t passes) {
    if (reached_.bytes() < passes * sizeof(uint32_t))
        reached_ = Buffer(device_, "progress", 2 * passes * sizeof(uint32_t), Memory::Host);
    passes_ = passes;
    next_ = 0;
    std::memset(reached_.mapped().data(), 0, passes * sizeof(uint32_t));
}

void Progress::passReached(VkCommandBuffer commands) {
    vkCmdFillBuffer(commands, reached_.handle(), next_++ * sizeof(uint32_t), sizeof(uint32_t), 1);
}

uint32_t Progress::lastReached() const {
    std::vector<uint32_t> words(passes_);
    std::memcpy(words.data(), reached_.mapped().data(), passes_ * sizeof(uint32_t));
    const auto end = std::find(words.begin(), words.end(), 0u);
    return end == words.begin() ? 0 : static_cast<uint32_t>(end - words.begin()) - 1;
}

} // namespace irradia
