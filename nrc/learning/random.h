// Pseudo-random numbers of the host: PCG32 (O'Neill 2014), the same on every platform.
#pragma once

#include <cstdint>

namespace irradia {

class RandomStream {
public:
    explicit RandomStream(uint64_t seed)
        : state_(seed + kIncrement) {
        next();
    }

    uint32_t next() {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005u + kIncrement;
        const auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
        const auto turn = static_cast<uint32_t>(old >> 59);
        return (shifted >> turn) | (shifted << ((32u - turn) & 31u));
    }
    // In [0, 1), 24 bits.
    float uniform() { return static_cast<float>(next() >> 8) * 0x1p-24f; }

private:
    static constexpr uint64_t kIncrement = 1442695040888963407u;
    uint64_t state_;
};

} // namespace irradia
