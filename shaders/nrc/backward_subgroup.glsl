// Backward pass: the gradient of the loss by every layer's sums (before its activation), a lane a few rows.
#include "lib/kernel.glsl"
#include "nrc/quads.glsl"
#include "nrc/mlp_shape.glsl"
#include "nrc/activation.glsl"

layout(constant_id = 9) const bool kInputGradient = false;

COUNTERS_READ(0, counters);
QUADS_READ(1, packed);
QUADS_READ(2, activations);
RECORDS_READ(3, results);
RECORDS_READ(4, resultGradient);
QUADS_WRITE(5, layerGradients);
QUADS_WRITE(6, inputGradient); // of one element where there is none
layout(push_constant) uniform Push { RowsParams params; };

#include "nrc/mlp_subgroup.glsl"

void beginWithResults(uint row) {
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        [[unroll]] for (uint q = 0u; q < kOutputQuads; ++q) {
            uint rowR = row + r * kSubgroupSize;
            uint result = quadIndex(rowR, q, kOutputQuads);
            vec4 gradient = uintBitsToFloat(loadRecord(resultGradient, result)) *
                            outputDerivative(uintBitsToFloat(loadRecord(results, result)));
            storeQuad(layerGradients, quadIndex(rowR, kActivationQuads + q, kGradientQuads), gradient);
            layerIn[r * kLargestQuads + q] = gradient;
        }
}

void finishBlock(uint row, uint layer, uint firstOutput) {
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        [[unroll]] for (uint j = 0u; j < kBlockQuads; ++j) {
            uint rowR = row + r * kSubgroupSize;
            uint quad = layer * kWidthQuads + firstOutput / 4u + j;
            vec4 activation = loadQuad(activations, quadIndex(rowR, quad, kActivationQuads));
            block[r * kBlockQuads + j] *= reluDerivative(activation);
            storeQuad(layerGradients, quadIndex(rowR, quad, kGradientQuads), block[r * kBlockQuads + j]);
        }
    appendBlock(firstOutput);
}

void storeInputGradient(uint row, uint firstInput) {
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        [[unroll]] for (uint j = 0u; j < kBlockQuads; ++j)
            storeQuad(inputGradient, quadIndex(row + r * kSubgroupSize, firstInput / 4u + j, kInputQuads),
                      block[r * kBlockQuads + j]);
}

void main() {
    uint row = firstRow();
    if (row - gl_SubgroupInvocationID >= counters[params.counter]) return;

    beginWithResults(row);
    for (uint first = 0u; first < kWidthQuads * 4u; first += kBlock) {
        multiplyBlock(kOutputTransposed, kOutputQuads, first);
        finishBlock(row, kHiddenLayers - 1u, first);
    }
    nextLayer(kWidthQuads);
    for (uint layer = kHiddenLayers - 1u; layer > 0u; --layer) {
        uint matrix = kTransposed + kHiddenMatrices + (layer - 1u) * kHiddenMatrixQuads;
        for (uint first = 0u; first < kWidthQuads * 4u; first += kBlock) {
            multiplyBlock(matrix, kWidthQuads, first);
            finishBlock(row, layer - 1u, first);
        }
        nextLayer(kWidthQuads);
    }
    if (kInputGradient)
        for (uint first = 0u; first < kInputQuads * 4u; first += kBlock) {
            multiplyBlock(kTransposed + kInputMatrix, kWidthQuads, first);
            storeInputGradient(row, first);
        }
}
