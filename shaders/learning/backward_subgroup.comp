#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#pragma variant backward_subgroup_half VALUES_IN_HALF
// Backward pass: the gradient of the loss by every layer's sums (before its activation), a lane a few rows.
#include "lib/kernel.glsl"
#include "learning/values.glsl"
#include "learning/mlp_shape.glsl"
#include "learning/activation.glsl"

layout(constant_id = kConstantInputGradient) const bool kInputGradient = false;

COUNTERS_READ(0, counters);
VALUES_READ(1, packed);
VALUES_READ(2, activations);
QUADS_READ(3, results);
QUADS_READ(4, resultGradient);
VALUES_WRITE(5, layerGradients);
VALUES_WRITE(6, inputGradient); // of one element where there is none
layout(push_constant) uniform Push { RowsParams params; };
#include "lib/store_by_address.glsl"

#include "learning/mlp_subgroup.glsl"

void beginWithResults(uint row) {
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        [[unroll]] for (uint q = 0u; q < kOutputQuads; ++q) {
            uint rowR = row + r * kSubgroupSize;
            uint result = quadIndex(rowR, q, kOutputQuads);
            vec4 gradient = uintBitsToFloat(loadQuad(resultGradient, result)) *
                            outputDerivative(uintBitsToFloat(loadQuad(results, result)));
            storeValuesAt(params.kept, quadIndex(rowR, kActivationQuads + q, kGradientQuads), gradient);
            layerIn[r * kLargestQuads + q] = gradient;
        }
}

void finishBlock(uint row, uint layer, uint quad) {
    uint column = layer * kWidthQuads + quad;
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        block[r] *= reluDerivative(loadValues(activations, quadIndex(row + r * kSubgroupSize, column, kActivationQuads)));
    appendBlock(quad);
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        storeValuesAt(params.kept, quadIndex(row + r * kSubgroupSize, column, kGradientQuads), block[r]);
}

void storeInputGradient(uint row, uint quad) {
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        storeValues(inputGradient, quadIndex(row + r * kSubgroupSize, quad, kInputQuads), block[r]);
}

void main() {
    uint row = firstRow();
    if (row - gl_SubgroupInvocationID >= ROW_COUNT) return;

    beginWithResults(row);
    for (uint quad = 0u; quad < kWidthQuads; ++quad) {
        multiplyBlock(kOutputTransposed, kOutputQuads, quad);
        finishBlock(row, kHiddenLayers - 1u, quad);
    }
    // From the last hidden matrix down to the first, or to that of the inputs.
    for (uint step = 0u; step < kHiddenLayers - (kInputGradient ? 0u : 1u); ++step) {
        nextLayer();
        uint layer = kHiddenLayers - 1u - step;
        bool isHidden = layer > 0u;
        uint matrix = isHidden ? kHiddenMatrices + (layer - 1u) * kHiddenMatrixQuads : kInputMatrix;
        for (uint quad = 0u; quad < (isHidden ? kWidthQuads : kInputQuads); ++quad) {
            multiplyBlock(kTransposed + matrix, kWidthQuads, quad);
            if (isHidden)
                finishBlock(row, layer - 1u, quad);
            else if (kInputGradient)
                storeInputGradient(row, quad);
        }
    }
}
