#version 460
#extension GL_GOOGLE_include_directive : require
// The batch's mean loss, which a batch without a usable record leaves as it is, and the factor that makes gradients those
// of the mean. One workgroup, sums in a fixed order.
#include "lib/kernel.glsl"
#include "nrc/state.glsl"

STATE(0);
WORDS_READ(1, rowLoss);
layout(push_constant) uniform Push { EndBatchParams params; };

shared float sums[gl_WorkGroupSize.x];

void main() {
    uint lane = gl_LocalInvocationID.x;
    float sum = 0.0;
    for (uint row = lane; row < state.batchRows; row += gl_WorkGroupSize.x) sum += uintBitsToFloat(loadWord(rowLoss, row));
    sums[lane] = sum;
    barrier();
    if (lane != 0u) return;
    float total = 0.0;
    for (uint i = 0u; i < gl_WorkGroupSize.x; ++i) total += sums[i];
    float count = float(state.validRecords) * float(params.outputs);
    if (state.validRecords > 0u) state.loss = total / count;
    state.gradientScale = 1.0 / (max(count, 1.0) * params.lossScale);
}
