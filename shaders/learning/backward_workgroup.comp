#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant backward_workgroup_half VALUES_IN_HALF
// Backward pass: the gradient of the loss by every layer's sums (before its activation), a workgroup a tile of rows.
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

#include "learning/mlp_workgroup.glsl"

void beginWithResults(uint first) {
    for (uint i = gl_LocalInvocationID.x; i < kGroupRows * kOutputQuads; i += kRowThreads * kQuadThreads) {
        uint row = first + i % kGroupRows, quad = i / kGroupRows;
        uint result = quadIndex(row, quad, kOutputQuads);
        vec4 gradient = uintBitsToFloat(loadQuad(resultGradient, result)) *
                        outputDerivative(uintBitsToFloat(loadQuad(results, result)));
        storeValues(layerGradients, quadIndex(row, kActivationQuads + quad, kGradientQuads), gradient);
        rowQuads[i] = toShared(gradient);
    }
}

// Through a transposed matrix to the layer before it.
void hiddenLayer(uint first, uint layer, uint matrix, uint quads) {
    multiplyLayer(matrix, quads, kWidthQuads * 4u);
    FOR_LAYER_SUMS(row, quad, sum, {
        uint layerQuad = layer * kWidthQuads + quad;
        vec4 gradient = sum * reluDerivative(loadValues(activations, quadIndex(first + row, layerQuad, kActivationQuads)));
        rowQuads[quad * kGroupRows + row] = toShared(gradient);
        storeValues(layerGradients, quadIndex(first + row, layerQuad, kGradientQuads), gradient);
    })
}

void inputLayer(uint first) {
    for (uint firstInput = 0u; firstInput < kInputQuads * 4u; firstInput += kBlockOutputs) {
        multiplyBlock(kTransposed + kInputMatrix, kWidthQuads, kInputQuads * 4u, firstInput);
        [[unroll]] for (uint k = 0u; k < kThreadRows; ++k)
            [[unroll]] for (uint m = 0u; m < kThreadQuads; ++m) {
                uint quad = firstInput / 4u + quadOfThread(m);
                if (quad < kInputQuads)
                    storeValues(inputGradient, quadIndex(first + rowOfThread(k), quad, kInputQuads), sums[k * kThreadQuads + m]);
            }
    }
}

void main() {
    uint first = firstRow();
    if (first >= ROW_COUNT) return;
    beginWithResults(first);
    for (uint layer = kHiddenLayers; layer > 0u; --layer)
        hiddenLayer(first, layer - 1u,
                    layer == kHiddenLayers ? kOutputTransposed
                                           : kTransposed + kHiddenMatrices + (layer - 1u) * kHiddenMatrixQuads,
                    layer == kHiddenLayers ? kOutputQuads : kWidthQuads);
    if (kInputGradient) inputLayer(first);
}
