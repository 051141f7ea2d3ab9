// How far a submission came, readable even when it never ends.
#pragma once

#include "engine/gpu/buffer.h"

namespace irradia {

class Progress {
public:
    explicit Progress(Device& device)
        : device_(device) {}

    void begin(uint32_t passes);
    void passReached(VkCommandBuffer commands); // before each pass
    uint32_t lastReached() const;               // 0 if none was

private:
    Device& device_;
    Buffer reached_; // a word per pass, mapped: 1 once the device came to it
    uint32_t passes_ = 0;
    uint32_t next_ = 0;
};

} // namespace irradia
