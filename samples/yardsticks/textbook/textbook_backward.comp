#version 460
#extension GL_GOOGLE_include_directive : require
// The loss' gradient by each layer's sums, of one row an invocation: mean squared error, then backwards through the
// transposed matrices.
#include "textbook.glsl"

FLOATS_READ(0, weights);
FLOATS_READ(1, activations);
FLOATS_READ(2, results);
FLOATS_READ(3, targets);
FLOATS_WRITE(4, resultGradients);
FLOATS_WRITE(5, hiddenGradients);

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= params.rows) return;
    float gradient[kWidest];
    float previous[kWidest];
    for (uint o = 0u; o < kOutputs; ++o) {
        uint at = row * kOutputs + o;
        gradient[o] = 2.0 * (results[at] - targets[at]) / float(params.rows * kOutputs);
        resultGradients[at] = gradient[o];
    }
    for (uint layer = kHiddenLayers; layer > 0u; --layer) {
        for (uint i = 0u; i < kWidth; ++i) {
            float sum = 0.0;
            for (uint o = 0u; o < layerOutputs(layer); ++o)
                sum += weights[firstWeight(layer) + o * kWidth + i] * gradient[o];
            previous[i] = activations[hiddenIndex(row, layer - 1u, i)] > 0.0 ? sum : 0.0;
        }
        for (uint i = 0u; i < kWidth; ++i) {
            gradient[i] = previous[i];
            hiddenGradients[hiddenIndex(row, layer - 1u, i)] = previous[i];
        }
    }
}
