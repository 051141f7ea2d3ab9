#version 460
#extension GL_GOOGLE_include_directive : require
// The loss' gradient by the weights: an invocation sums one weight's over all rows.
#include "textbook.glsl"

FLOATS_READ(0, inputs);
FLOATS_READ(1, activations);
FLOATS_READ(2, resultGradients);
FLOATS_READ(3, hiddenGradients);
FLOATS_WRITE(4, gradients);

void main() {
    uint weight = gl_GlobalInvocationID.x;
    if (weight >= params.weights) return;
    uint layer = weight < firstWeight(1u) ? 0u : 1u + (weight - firstWeight(1u)) / (kWidth * kWidth);
    layer = min(layer, kHiddenLayers);
    uint output_ = (weight - firstWeight(layer)) / layerInputs(layer);
    uint input_ = (weight - firstWeight(layer)) % layerInputs(layer);
    float sum = 0.0;
    for (uint row = 0u; row < params.rows; ++row) {
        float value = layer == 0u ? inputs[row * kInputs + input_] : activations[hiddenIndex(row, layer - 1u, input_)];
        float gradient = layer == kHiddenLayers ? resultGradients[row * kOutputs + output_]
                                                : hiddenGradients[hiddenIndex(row, layer, output_)];
        sum += value * gradient;
    }
    gradients[weight] = sum;
}
