#version 460
#extension GL_GOOGLE_include_directive : require
// Random numbers of keys along a line in (pixel, sample, block, seed).
#include "lib/kernel.glsl"
#include "lib/rng.glsl"
#include "harness.h"

QUADS_WRITE(0, bits);
layout(push_constant) uniform Push { RngHarnessParams params; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    uvec4 key = params.first + i * params.step;
    storeQuad(bits, i, randomBits(key.x, key.y, key.z, key.w));
}
