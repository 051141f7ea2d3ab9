// Forward pass, a lane a few rows (mlp_subgroup.glsl).
#include "lib/kernel.glsl"
#include "nrc/quads.glsl"
#include "nrc/mlp_shape.glsl"
#include "nrc/activation.glsl"

COUNTERS_READ(0, counters);
QUADS_READ(1, encoded);
QUADS_READ(2, packed);
RECORDS_WRITE(3, results);
#ifdef KEEP_ACTIVATIONS
QUADS_WRITE(4, activations);
#endif
layout(push_constant) uniform Push { RowsParams params; };

#include "nrc/mlp_subgroup.glsl"

void keep(uint row, uint layer, uint firstOutput) {
#ifdef KEEP_ACTIVATIONS
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        [[unroll]] for (uint j = 0u; j < kBlockQuads; ++j)
            storeQuad(activations, quadIndex(row + r * kSubgroupSize, layer * kWidthQuads + firstOutput / 4u + j, kActivationQuads),
                      block[r * kBlockQuads + j]);
#endif
}

void finishBlock(uint row, uint layer, uint firstOutput) {
    [[unroll]] for (uint k = 0u; k < kRows * kBlockQuads; ++k) block[k] = relu(block[k]);
    keep(row, layer, firstOutput);
    appendBlock(firstOutput);
}

void main() {
    uint row = firstRow();
    if (row - gl_SubgroupInvocationID >= counters[params.counter]) return;

    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        [[unroll]] for (uint i = 0u; i < kInputQuads; ++i)
            layerIn[r * kLargestQuads + i] = loadQuad(encoded, quadIndex(row + r * kSubgroupSize, i, kInputQuads));

    for (uint first = 0u; first < kWidthQuads * 4u; first += kBlock) {
        multiplyBlock(kInputMatrix, kInputQuads, first);
        finishBlock(row, 0u, first);
    }
    nextLayer(kWidthQuads);
    for (uint layer = 1u; layer < kHiddenLayers; ++layer) {
        uint matrix = kHiddenMatrices + (layer - 1u) * kHiddenMatrixQuads;
        for (uint first = 0u; first < kWidthQuads * 4u; first += kBlock) {
            multiplyBlock(matrix, kWidthQuads, first);
            finishBlock(row, layer, first);
        }
        nextLayer(kWidthQuads);
    }
    for (uint first = 0u; first < kOutputQuads * 4u; first += kBlock) {
        multiplyBlock(kOutputMatrix, kWidthQuads, first);
        [[unroll]] for (uint r = 0u; r < kRows; ++r)
            [[unroll]] for (uint j = 0u; j < kBlockQuads; ++j)
                if (first / 4u + j < kOutputQuads)
                    storeRecord(results, quadIndex(row + r * kSubgroupSize, first / 4u + j, kOutputQuads),
                                floatBitsToUint(activateOutput(block[r * kBlockQuads + j])));
    }
}
