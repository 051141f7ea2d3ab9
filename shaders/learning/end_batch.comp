#version 460
#extension GL_GOOGLE_include_directive : require
// How many records of the batch were used, its mean loss and brightness, which a batch without any leaves as they are, and
// the factor that makes gradients those of the mean. One workgroup, sums in a fixed order.
#include "lib/kernel.glsl"
#include "learning/state.glsl"

STATE(0);
QUADS_READ(1, rowSums);
layout(push_constant) uniform Push { EndBatchParams params; };

shared vec4 sums[gl_WorkGroupSize.x];

// Batches are of one size, or nearly: the mean over a pass is that of their means.
void addToPass(vec2 brightness) {
    if (params.batch == kLaterPass) return;
    vec2 before = params.batch == 0u ? brightness : vec2(state.meanPrediction, state.meanTarget);
    vec2 mean = before + (brightness - before) / float(params.batch + 1u);
    state.meanPrediction = mean.x;
    state.meanTarget = mean.y;
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    vec4 sum = vec4(0.0);
    for (uint row = lane; row < state.batchRows; row += gl_WorkGroupSize.x)
        sum += uintBitsToFloat(loadQuad(rowSums, row));
    sums[lane] = sum;
    barrier();
    if (lane != 0u) return;
    vec4 total = vec4(0.0);
    for (uint i = 0u; i < gl_WorkGroupSize.x; ++i) total += sums[i];
    state.validRecords = uint(total.w); // exact: a batch has fewer than 2^24 rows
    float count = float(state.validRecords) * float(params.outputs);
    if (state.validRecords > 0u) {
        state.loss = total.x / count;
        addToPass(total.yz / float(state.validRecords));
    }
    state.gradientScale = 1.0 / (max(count, 1.0) * params.lossScale);
}
