// Half precision (IEEE 754 binary16), to the nearest, ties to even.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace irradia::reference {

constexpr double kHalfMax = 65504.0;

inline double roundToHalf(double x) {
    if (!std::isfinite(x) || x == 0.0) return x;
    const int exponent = std::max(std::ilogb(x), -14); // below 2^-14: subnormal, of spacing 2^-24
    const double rounded = std::ldexp(std::nearbyint(std::ldexp(x, 10 - exponent)), exponent - 10);
    return std::abs(rounded) > kHalfMax ? std::copysign(INFINITY, x) : rounded;
}

// The value of the 16 bits.
inline double halfFromBits(uint16_t bits) {
    const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
    const double sign = bits >> 15 != 0 ? -1.0 : 1.0;
    if (exponent == 31) return mantissa != 0 ? NAN : sign * INFINITY;
    return sign * (exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(mantissa + 1024, exponent - 25));
}

inline uint16_t halfBits(double x) {
    const auto sign = static_cast<uint16_t>(std::signbit(x) ? 0x8000 : 0);
    if (std::isnan(x)) return sign | 0x7e00;
    const double magnitude = std::abs(roundToHalf(x));
    if (std::isinf(magnitude)) return sign | 0x7c00;
    // Bits of positive halves count them: 2^-24 apart below 2^-14, then 1024 to a power of two.
    const int exponent = magnitude == 0.0 ? -14 : std::max(std::ilogb(magnitude), -14);
    const auto count = static_cast<int>(std::ldexp(magnitude, 10 - exponent));
    return static_cast<uint16_t>(sign | ((exponent + 14) * 1024 + count));
}

} // namespace irradia::reference
