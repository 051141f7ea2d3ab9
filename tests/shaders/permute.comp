#version 460
#extension GL_GOOGLE_include_directive : require
// Places of 0, 1, 2, ... in the permutation of `count` numbers under `key`: result record i holds that of i in x.
#include "lib/kernel.glsl"
#include "lib/permutation.glsl"
#include "harness.h"

QUADS_WRITE(0, results);
layout(push_constant) uniform Push { PermuteParams params; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < params.count) storeQuad(results, i, uvec4(permute(i, params.count, params.key)));
}
