#version 460
#extension GL_GOOGLE_include_directive : require
// Equirectangular coordinates of given directions, and the directions of those coordinates.
#include "lib/kernel.glsl"
#include "lib/sampling.glsl"
#include "harness.h"

QUADS_READ(0, directions);
QUADS_WRITE(1, results); // 2 each: u, v; direction of (u, v)
layout(push_constant) uniform Push { WarpHarnessParams params; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    vec2 uv = equirectOfDirection(uintBitsToFloat(loadQuad(directions, i).xyz));
    storeQuad(results, 2u * i, floatBitsToUint(vec4(uv, 0.0, 0.0)));
    storeQuad(results, 2u * i + 1u, floatBitsToUint(vec4(directionOfEquirect(uv), 0.0)));
}
