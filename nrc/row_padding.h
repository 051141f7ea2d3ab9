// How many rows a batch's buffers have room for: whole multiples of gpu::kRowPadding.
#pragma once

#include "shared/network.h"
#include <algorithm>
#include <cstdint>

namespace irradia {

// At least `rows`, and never none.
constexpr uint32_t paddedRows(uint32_t rows) {
    return (std::max(rows, 1u) + gpu::kRowPadding - 1) / gpu::kRowPadding * gpu::kRowPadding;
}

} // namespace irradia
