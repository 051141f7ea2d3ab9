// How many rows a batch on the device has.
#pragma once

#include "engine/gpu/buffer.h"

namespace irradia {

// A batch of rows on the device, or a part of it: how many the batch has is word `index` of `counters`.
struct RowCount {
    BufferRange counters;
    uint32_t index = 0;
    uint32_t capacity = 0; // a multiple of gpu::kRowPadding
    uint32_t first = 0;    // likewise: the buffers hold rows [first, first + capacity) of the batch alone
};

} // namespace irradia
