// Numbers that scatter objects and grain textures: the same on every machine.
#pragma once

#include <cstdint>

namespace irradia::scenes {

// PCG's RXS-M-XS output permutation (O'Neill 2014) of a key: neighbouring keys give unrelated values.
inline uint32_t hash(uint32_t key) {
    const uint32_t state = key * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

class Random {
public:
    explicit Random(uint32_t seed)
        : state_(hash(seed)) {}

    // Uniform in [lower, upper).
    float between(float lower, float upper) {
        state_ = hash(state_);
        return lower + (upper - lower) * static_cast<float>(state_ >> 8) * 0x1p-24f;
    }

private:
    uint32_t state_;
};

} // namespace irradia::scenes
