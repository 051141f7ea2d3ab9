// Rows of the networks (shared/network.h) as plain matrices: row-major, `width` values a row, no padding.
#pragma once

#include "engine/gpu/buffer.h"
#include "nrc/learning/config.h"
#include "tests/support/kernel_harness.h"

namespace irradia::test {

struct RowFormat {
    uint32_t width = 0; // values a row; the rest of the last quad is padding
    Precision precision = Precision::Float;

    uint32_t quads() const { return (width + 3) / 4; }
    uint64_t valueBytes() const { return precision == Precision::Half ? 2 : 4; }
    uint64_t bytes(uint32_t capacity) const { return uint64_t{capacity} * quads() * 4 * valueBytes(); }
};

// The value as a buffer of that precision holds it.
double stored(double value, Precision precision);

// A buffer of `capacity` rows, the first of which are `rows`; padding and further rows hold `filling`.
Buffer rowBuffer(const RowFormat& format, uint32_t capacity, const std::vector<double>& rows, double filling,
                 Device& device = validatedDevice());

// The first `count` rows of the buffer.
std::vector<double> downloadRows(const Buffer& buffer, const RowFormat& format, uint32_t count,
                                 Device& device = validatedDevice());

} // namespace irradia::test
