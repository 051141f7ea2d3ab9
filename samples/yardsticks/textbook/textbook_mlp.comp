#version 460
#extension GL_GOOGLE_include_directive : require
// A multilayer perceptron as first written: an invocation evaluates one row, layer by layer, in private arrays.
#include "textbook.glsl"

layout(constant_id = 6) const bool kKeepActivations = false;

FLOATS_READ(0, inputs);
FLOATS_READ(1, weights);
FLOATS_WRITE(2, activations);
FLOATS_WRITE(3, results);

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= params.rows) return;
    float values[kWidest];
    float next[kWidest];
    for (uint i = 0u; i < kInputs; ++i) values[i] = inputs[row * kInputs + i];
    for (uint layer = 0u; layer <= kHiddenLayers; ++layer) {
        for (uint o = 0u; o < layerOutputs(layer); ++o) {
            float sum = 0.0;
            for (uint i = 0u; i < layerInputs(layer); ++i)
                sum += weights[firstWeight(layer) + o * layerInputs(layer) + i] * values[i];
            next[o] = layer < kHiddenLayers ? max(sum, 0.0) : sum;
        }
        for (uint o = 0u; o < layerOutputs(layer); ++o) {
            values[o] = next[o];
            if (kKeepActivations && layer < kHiddenLayers) activations[hiddenIndex(row, layer, o)] = next[o];
        }
    }
    for (uint o = 0u; o < kOutputs; ++o) results[row * kOutputs + o] = values[o];
}
