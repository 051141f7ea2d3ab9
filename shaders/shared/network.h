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

// Activation of the output layer (network.comp constant).
SHARED_CONST uint kOutputNone = 0u;
SHARED_CONST uint kOutputReLU = 1u;
SHARED_CONST uint kOutputExponential = 2u; // exp(min(z, 30))
SHARED_CONST uint kOutputSoftplus = 3u;    // log(1 + exp(z))

// Where a batch's number of rows stands: word `counter` of a buffer of uints.
struct RowsParams {
    uint counter;
    uint capacity; // rows that the buffers have room for, a multiple of kRowPadding
};

// encode_*: one encoding of a composite. Inputs are rows of single-precision quads.
struct EncodeParams {
    uint counter;
    uint inputQuads;   // of a row
    uint firstInput;   // first of the inputs that this encoding reads
    uint encodedQuads; // of a row of the whole composite
    uint firstQuad;    // first that this encoding writes
};

// weight_gradient: rows are summed in kGradientChunks chunks of chunkRows rows, a multiple of kTileRows.
SHARED_CONST uint kGradientChunks = 32u;
struct WeightGradientParams {
    uint counter;
    uint chunkRows;
    uint blocks;      // that tile all matrices
    uint weightQuads; // of a chunk's partial sums
};

struct SumGradientsParams {
    uint weightQuads;
    uint scaleWord; // of the buffer that holds the factor
};

struct PackParams {
    uint packedQuads;
};

SHARED_END
#endif
