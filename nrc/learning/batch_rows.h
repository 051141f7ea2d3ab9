// How many rows a batch's buffers have room for, and how a batch is cut: into chunks, over each of which the
// weights' gradient is summed, and parts of whole chunks, which pass through the network one after the other.
// The chunks follow from the batch alone, so that a result does not depend on the parts. Pure.
#pragma once

#include "shared/network.h"
#include <algorithm>
#include <cstdint>

namespace irradia {

// At least `rows`, and never none: whole multiples of gpu::kRowPadding.
constexpr uint32_t paddedRows(uint32_t rows) {
    return (std::max(rows, 1u) + gpu::kRowPadding - 1) / gpu::kRowPadding * gpu::kRowPadding;
}

// Rows of a chunk: a batch has gpu::kGradientChunks of them, and more only where they would be larger than
// what any device's binding holds of a part.
constexpr uint32_t kLargestChunk = 1u << 14;
constexpr uint32_t chunkRows(uint32_t batchRows) {
    return std::min(paddedRows((batchRows + gpu::kGradientChunks - 1) / gpu::kGradientChunks), kLargestChunk);
}
constexpr uint32_t chunkCount(uint32_t rows, uint32_t ofChunk) {
    return (rows + ofChunk - 1) / ofChunk;
}

// Rows [first, first + rows) of a batch.
struct RowRange {
    uint32_t first = 0;
    uint32_t rows = 0;
};

struct BatchRows {
    // Room for `wanted` rows, in parts of at most `mostOfPart` rows or one chunk.
    BatchRows(uint32_t wanted, uint32_t mostOfPart)
        : rows(paddedRows(wanted))
        , partRows(std::min(rows, std::max(mostOfPart / chunkRows(rows), 1u) * chunkRows(rows))) {}

    uint32_t rows;
    uint32_t partRows; // of a part, whole chunks; the last one may be shorter

    RowRange partFrom(uint32_t first) const { return {first, std::min(partRows, rows - first)}; }
};

} // namespace irradia
