// Streams of pseudo-random numbers: xoshiro256++ (Blackman and Vigna 2021, "Scrambled linear pseudorandom
// number generators"), its state filled by SplitMix64 (Steele, Lea and Flood 2014) from a seed and a stream
// number.
#pragma once

#include "tests/reference/math.h"
#include <array>
#include <bit>
#include <cstdint>

namespace irradia::reference {

class Random {
public:
    explicit Random(uint64_t seed, uint64_t stream = 0) {
        uint64_t counter = splitMix(seed) ^ splitMix(~stream);
        for (uint64_t& word : state_) word = splitMix(counter += kGoldenGamma);
    }

    // Uniform in [0, 1), 53 bits.
    double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
    Vec2 uniform2() {
        const double first = uniform();
        return {first, uniform()};
    }

private:
    static constexpr uint64_t kGoldenGamma = 0x9e3779b97f4a7c15u;

    static uint64_t splitMix(uint64_t x) {
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }

    uint64_t next() {
        auto& [a, b, c, d] = state_;
        const uint64_t result = std::rotl(a + d, 23) + a;
        const uint64_t shifted = b << 17;
        c ^= a;
        d ^= b;
        b ^= c;
        a ^= d;
        c ^= shifted;
        d = std::rotl(d, 45);
        return result;
    }

    std::array<uint64_t, 4> state_{};
};

} // namespace irradia::reference
