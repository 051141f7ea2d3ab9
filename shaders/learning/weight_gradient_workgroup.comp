#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant weight_gradient_workgroup_half VALUES_IN_HALF
// Sum over rows of layer gradient x activation: partial sums of fixed chunks of rows. A workgroup owns one block of a
// matrix (weight_blocks.glsl); tiles of rows pass through shared memory. A thread owns 8 outputs by one quad of inputs.
#include "lib/kernel.glsl"
#include "learning/values.glsl"
#include "learning/mlp_shape.glsl"

COUNTERS_READ(0, counters);
VALUES_READ(1, encoded);
VALUES_READ(2, activations);
VALUES_READ(3, layerGradients);
QUADS_WRITE(4, partials); // a chunk after the other, each laid out as the weights
layout(push_constant) uniform Push { WeightGradientParams params; };

layout(constant_id = kConstantOutputsTogether) const uint kOutputsTogether = 64u;
layout(constant_id = kConstantQuadsTogether) const uint kQuadsTogether = 16u;
const uint kThreadOutputs = 8u;
const uint kOutputQuadsTogether = kOutputsTogether / 4u;
const uint kThreads = kQuadsTogether * (kOutputsTogether / kThreadOutputs);
const uint kStagedRows = 32u;

shared vec4 gradients[kStagedRows * kOutputQuadsTogether]; // [row][quad]
shared vec4 inputs[kStagedRows * kQuadsTogether];

#include "learning/weight_blocks.glsl"

void stage(Block b, uint firstRow, uint end) {
    for (uint i = gl_LocalInvocationID.x; i < kStagedRows * kOutputQuadsTogether; i += kThreads) {
        uint row = firstRow + i / kOutputQuadsTogether, quad = i % kOutputQuadsTogether;
        gradients[i] = row < end && quad < b.gradientQuads
                           ? loadValues(layerGradients, quadIndex(row, b.gradientQuad + quad, kGradientQuads))
                           : vec4(0.0);
    }
    // Threads of one quad take turns at its rows.
    for (uint row = gl_LocalInvocationID.x / kQuadsTogether; row < kStagedRows; row += kOutputsTogether / kThreadOutputs)
        inputs[row * kQuadsTogether + gl_LocalInvocationID.x % kQuadsTogether] =
            firstRow + row < end && b.quad < b.matrixQuads ? activationOf(b, firstRow + row) : vec4(0.0);
}

void main() {
    uint chunk = gl_WorkGroupID.x / params.blocks;
    uint threadQuad = gl_LocalInvocationID.x % kQuadsTogether;
    uint threadOutput = gl_LocalInvocationID.x / kQuadsTogether * kThreadOutputs;
    Block b = blockAt(gl_WorkGroupID.x % params.blocks, threadQuad);
    uint begin = chunk * params.chunkRows;
    uint end = min(begin + params.chunkRows, ROW_COUNT);

    vec4 sums[kThreadOutputs];
    [[unroll]] for (uint o = 0u; o < kThreadOutputs; ++o) sums[o] = vec4(0.0);
    for (uint first = begin; first < end; first += kStagedRows) {
        barrier();
        stage(b, first, end);
        barrier();
        for (uint row = 0u; row < kStagedRows; ++row) {
            vec4 x = inputs[row * kQuadsTogether + threadQuad];
            [[unroll]] for (uint j = 0u; j < kThreadOutputs / 4u; ++j) {
                vec4 g = gradients[row * kOutputQuadsTogether + threadOutput / 4u + j];
                [[unroll]] for (uint c = 0u; c < 4u; ++c) sums[j * 4u + c] += g[c] * x;
            }
        }
    }
    uint outputs = b.gradientQuads * 4u; // the output matrix has fewer than a block
    if (b.quad >= b.matrixQuads) return;
    [[unroll]] for (uint o = 0u; o < kThreadOutputs; ++o)
        if (threadOutput + o < max(outputs, kFeaturePadding))
            storeQuad(partials, (params.firstChunk + chunk) * params.weightQuads + b.matrix + (b.firstOutput + threadOutput + o) * b.matrixQuads + b.quad,
                        floatBitsToUint(sums[o]));
}
