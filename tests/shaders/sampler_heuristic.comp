#version 460
#extension GL_GOOGLE_include_directive : require
// The power heuristic of pairs of densities, both ways round.
#include "lib/kernel.glsl"
#include "lib/sampling.glsl"
#include "harness.h"

QUADS_READ(0, densities); // p, q
QUADS_WRITE(1, weights);  // of p against q, of q against p
layout(push_constant) uniform Push { WarpHarnessParams params; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    vec2 pq = uintBitsToFloat(loadQuad(densities, i).xy);
    storeQuad(weights, i, floatBitsToUint(vec4(powerHeuristic(pq.x, pq.y), powerHeuristic(pq.y, pq.x), 0.0, 0.0)));
}
