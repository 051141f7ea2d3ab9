// Layouts of what networks read and write, and the state of their training.
//
// Rows. A batch is a matrix of rows (samples) by features, stored in quads: 4 consecutive features of one row, 16 bytes
// in single and 8 bytes in half precision. Eight rows make a tile, in which a quad of all eight stands together, so that
// lanes which own neighbouring rows touch neighbouring memory and nothing is ever transposed.
//
// Rows beyond a batch's count, up to the next multiple of kRowPadding, exist in every buffer: they may be computed, and
// are never used.
#ifndef IRRADIA_SHARED_NETWORK_H
#define IRRADIA_SHARED_NETWORK_H
#include "shared/types.h"
SHARED_BEGIN

SHARED_CONST uint kTileRows = 8u;
SHARED_CONST uint kRowPadding = 256u; // capacities of batches are multiples of it
SHARED_CONST uint kFeaturePadding = 16u; // encoded inputs and stored weights are padded to multiples of it

// Element of a buffer with `quads` quads a row.
SHARED_FUNCTION uint quadIndex(uint row, uint quad, uint quads) {
    return (row / kTileRows * quads + quad) * kTileRows + row % kTileRows;
}

// Activation of the output layer (kConstantOutputActivation).
SHARED_CONST uint kOutputNone = 0u;
SHARED_CONST uint kOutputReLU = 1u;
SHARED_CONST uint kOutputExponential = 2u; // exp(min(z, 30))
SHARED_CONST uint kOutputSoftplus = 3u;    // log(1 + exp(z))

// Rows [first, first + capacity) of a batch, whose number of rows is word `counter` of a buffer of uints. Buffers hold
// these alone, and have room for all of them.
struct RowsParams {
    uint counter;
    uint capacity; // a multiple of kRowPadding
    uint first;    // likewise
    uint unused;   // to a multiple of 8 bytes
    uvec2 kept;    // address of what a training pass keeps, where its kernel stores by address; else 0
};

// A level of a feature grid. A point p of the unit cube lies at p scale + 1/2 in cells, and corner (x, y, z) has entry
// first + x + stride (y + stride z), or of a hashed level first + hash % size.
SHARED_CONST uint kMaxGridLevels = 16u;
struct GridLevel {
    float scale;
    uint stride; // 0 where hashed
    uint first;  // of a sparse grid: in the table that says which entry a corner has
    uint size;   // entries; a power of two where hashed
};

SHARED_CONST uint kGridDense = 0u;
SHARED_CONST uint kGridHash = 1u;
SHARED_CONST uint kGridSparse = 2u;
SHARED_CONST uint kAbsentEntry = 0xffffffffu; // of a corner that a sparse grid does not store

// Sums of gradients by features in fixed point, S = high 2^32 + low with a signed low word, so that the high one is seldom
// touched: first the low words of all features, then the high ones. A contribution is cut to +-kLargestContribution.
SHARED_CONST float kGradientUnits = 1048576.0f;    // in 1
SHARED_CONST float kLargestContribution = 2047.0f; // keeps its units below 2^31

// weight_gradient: a batch's rows are summed in kGradientChunks chunks of chunkRows rows, a multiple of kRowPadding (of huge
// batches in more: nrc/learning/batch_rows.h). A pass sums `chunks` of them, from firstChunk on, whose rows are those from `first` on.
SHARED_CONST uint kGradientChunks = 32u;
struct WeightGradientParams {
    uint counter;
    uint first;
    uint firstChunk;
    uint chunks;
    uint chunkRows;
    uint blocks;      // that tile all matrices
    uint weightQuads; // of a chunk's partial sums
};

struct SumGradientsParams {
    uint chunks;
    uint weightQuads;
    uint scaleWord; // of the buffer that holds the factor
};

struct PackParams {
    uint packedQuads;
};

SHARED_END
#endif
