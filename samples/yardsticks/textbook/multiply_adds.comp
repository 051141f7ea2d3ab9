#version 460
#extension GL_GOOGLE_include_directive : require
// Nothing but multiply-adds, in registers: what a device can do at most.
#include "lib/kernel.glsl"
#include "device_peak.h"

WORDS_WRITE(0, results);
layout(push_constant) uniform Push { DevicePeakParams params; };

void main() {
    vec4 sums[kPeakSums];
    [[unroll]] for (uint i = 0u; i < kPeakSums; ++i) sums[i] = vec4(gl_GlobalInvocationID.x + i);
    for (uint n = 0u; n < params.iterations; ++n)
        [[unroll]] for (uint k = 0u; k < kPeakUnroll * kPeakSums; ++k)
            sums[k % kPeakSums] = fma(sums[k % kPeakSums], vec4(params.factor), vec4(params.term));
    vec4 total = vec4(0.0);
    [[unroll]] for (uint i = 0u; i < kPeakSums; ++i) total += sums[i];
    storeWord(results, gl_GlobalInvocationID.x, floatBitsToUint(dot(total, vec4(1.0))));
}
