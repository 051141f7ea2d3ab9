#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant forward_workgroup_half VALUES_IN_HALF
#pragma variant infer_workgroup EVALUATE_ONLY
#pragma variant infer_workgroup_half VALUES_IN_HALF EVALUATE_ONLY
// Forward pass, a workgroup a tile of rows (mlp_workgroup.glsl).
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

#include "learning/mlp_workgroup.glsl"

void loadInputs(uint first) {
    for (uint i = gl_LocalInvocationID.x; i < kGroupRows * kInputQuads; i += kRowThreads * kQuadThreads)
        rowQuads[i] = toShared(loadValues(encoded, quadIndex(first + i % kGroupRows, i / kGroupRows, kInputQuads)));
}

void keep(uint row, uint quad, vec4 activation) {
#ifndef EVALUATE_ONLY
    storeValues(activations, quadIndex(row, quad, kActivationQuads), activation);
#endif
}

void finishHidden(uint first, uint layer) {
    FOR_LAYER_SUMS(row, quad, sum, {
        vec4 activation = relu(sum);
        rowQuads[quad * kGroupRows + row] = toShared(activation);
        keep(first + row, layer * kWidthQuads + quad, activation);
    })
}

void storeResults(uint first) {
    FOR_LAYER_SUMS(row, quad, sum, {
        if (quad < kOutputQuads)
            storeQuad(results, quadIndex(first + row, quad, kOutputQuads), floatBitsToUint(activateOutput(sum)));
    })
}

void main() {
    uint first = firstRow();
    if (first >= ROW_COUNT) return;
    loadInputs(first);
    for (uint layer = 0u; layer <= kHiddenLayers; ++layer) { // the last one is the output layer
        bool isInput = layer == 0u, isHidden = layer < kHiddenLayers;
        multiplyLayer(isInput ? kInputMatrix : kHiddenMatrices + (layer - 1u) * kHiddenMatrixQuads,
                      isInput ? kInputQuads : kWidthQuads, isHidden ? kWidthQuads * 4u : kFeaturePadding);
        if (isHidden)
            finishHidden(first, layer);
        else
            storeResults(first);
    }
}
