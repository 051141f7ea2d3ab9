#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#pragma variant forward_subgroup_half VALUES_IN_HALF
#pragma variant infer_subgroup EVALUATE_ONLY
#pragma variant infer_subgroup_half VALUES_IN_HALF EVALUATE_ONLY
// Forward pass, a lane a few rows (mlp_subgroup.glsl).
#include "lib/kernel.glsl"
#include "learning/values.glsl"
#include "learning/mlp_shape.glsl"
#include "learning/activation.glsl"

COUNTERS_READ(0, counters);
VALUES_READ(1, encoded);
VALUES_READ(2, packed);
QUADS_WRITE(3, results);
#ifndef EVALUATE_ONLY
VALUES_WRITE(4, activations);
#endif
layout(push_constant) uniform Push { RowsParams params; };
#ifndef EVALUATE_ONLY
#include "lib/store_by_address.glsl"
#endif

#include "learning/mlp_subgroup.glsl"

void keep(uint row, uint layer, uint quad) {
#ifndef EVALUATE_ONLY
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        storeValuesAt(params.kept, quadIndex(row + r * kSubgroupSize, layer * kWidthQuads + quad, kActivationQuads), block[r]);
#endif
}

void finishBlock(uint row, uint layer, uint quad) {
    [[unroll]] for (uint r = 0u; r < kRows; ++r) block[r] = relu(block[r]);
    keep(row, layer, quad);
    appendBlock(quad);
}

void storeResults(uint row, uint quad) {
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        storeQuad(results, quadIndex(row + r * kSubgroupSize, quad, kOutputQuads), floatBitsToUint(activateOutput(block[r])));
}

void main() {
    uint row = firstRow();
    if (row - gl_SubgroupInvocationID >= ROW_COUNT) return;

    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        [[unroll]] for (uint i = 0u; i < kInputQuads; ++i)
            layerIn[r * kLargestQuads + i] = loadValues(encoded, quadIndex(row + r * kSubgroupSize, i, kInputQuads));

    for (uint quad = 0u; quad < kWidthQuads; ++quad) {
        multiplyBlock(kInputMatrix, kInputQuads, quad);
        finishBlock(row, 0u, quad);
    }
    // The last one is the output layer, whose matrix follows the hidden ones: unrolled a second time, that code is half
    // as long to compile again.
    for (uint layer = 1u; layer <= kHiddenLayers; ++layer) {
        nextLayer();
        bool isHidden = layer < kHiddenLayers;
        for (uint quad = 0u; quad < (isHidden ? kWidthQuads : kOutputQuads); ++quad) {
            multiplyBlock(kHiddenMatrices + (layer - 1u) * kHiddenMatrixQuads, kWidthQuads, quad);
            if (isHidden)
                finishBlock(row, layer, quad);
            else
                storeResults(row, quad);
        }
    }
}
