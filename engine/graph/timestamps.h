// The device's clock between the passes of one submission.
#pragma once

#include "engine/gpu/device.h"

namespace irradia {

class Timestamps {
public:
    explicit Timestamps(const Device& device)
        : device_(device) {}
    ~Timestamps();
    Timestamps(const Timestamps&) = delete;
    Timestamps& operator=(const Timestamps&) = delete;

    // Starts the clock of `passes` passes; does nothing where the queue has no timestamps.
    void begin(VkCommandBuffer commands, uint32_t passes);
    void passDone(VkCommandBuffer commands); // after each pass, its barrier counted in

    // After the submission: milliseconds of each pass, empty where there are no timestamps.
    std::vector<double> milliseconds() const;

private:
    const Device& device_;
    VkQueryPool pool_ = VK_NULL_HANDLE;
    uint32_t room_ = 0;
    uint32_t passes_ = 0;
    uint32_t written_ = 0;
};

} // namespace irradia
