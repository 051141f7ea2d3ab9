#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant forward_workgroup_half QUADS_IN_HALF
#pragma variant infer_workgroup EVALUATE_ONLY
#pragma variant infer_workgroup_half QUADS_IN_HALF EVALUATE_ONLY
// Forward pass, a workgroup a tile of rows (mlp_workgroup.glsl).
#include "lib/kernel.glsl"
#include "nrc/quads.glsl"
#include "nrc/mlp_shape.glsl"
#include "nrc/activation.glsl"

COUNTERS_READ(0, counters);
QUADS_READ(1, encoded);
QUADS_READ(2, packed);
RECORDS_WRITE(3, results);
#ifndef EVALUATE_ONLY
QUADS_WRITE(4, activations);
#endif
layout(push_constant) uniform Push { RowsParams params; };

#include "nrc/mlp_workgroup.glsl"

void loadInputs(uint first) {
    for (uint i = gl_LocalInvocationID.x; i < kGroupRows * kInputQuads; i += kRowThreads * kQuadThreads)
        rowQuads[i] = toShared(loadQuad(encoded, quadIndex(first + i % kGroupRows, i / kGroupRows, kInputQuads)));
}

void keep(uint row, uint quad, vec4 activation) {
#ifndef EVALUATE_ONLY
    storeQuad(activations, quadIndex(row, quad, kActivationQuads), activation);
#endif
}

void hiddenLayer(uint first, uint layer, uint matrix, uint quads) {
    multiplyLayer(matrix, quads);
    FOR_LAYER_SUMS(row, quad, sum, {
        vec4 activation = relu(sum);
        rowQuads[quad * kGroupRows + row] = toShared(activation);
        keep(first + row, layer * kWidthQuads + quad, activation);
    })
}

void outputLayer(uint first) {
    multiplyBlock(kOutputMatrix, kWidthQuads, kFeaturePadding, 0u);
    [[unroll]] for (uint k = 0u; k < kThreadRows; ++k)
        [[unroll]] for (uint m = 0u; m < kThreadQuads; ++m)
            if (quadOfThread(m) < kOutputQuads)
                storeRecord(results, quadIndex(first + rowOfThread(k), quadOfThread(m), kOutputQuads),
                            floatBitsToUint(activateOutput(sums[k * kThreadQuads + m])));
}

void main() {
    uint first = firstRow();
    if (first >= ROW_COUNT) return;
    loadInputs(first);
    hiddenLayer(first, 0u, kInputMatrix, kInputQuads);
    for (uint layer = 1u; layer < kHiddenLayers; ++layer)
        hiddenLayer(first, layer, kHiddenMatrices + (layer - 1u) * kHiddenMatrixQuads, kWidthQuads);
    outputLayer(first);
}
