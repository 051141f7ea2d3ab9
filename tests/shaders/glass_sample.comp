#version 460
#extension GL_GOOGLE_include_directive : require
// Directions drawn from one case, and their densities (0 = nothing is scattered).
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, cases);
QUADS_READ(1, reflectanceTable);
QUADS_READ(2, glassTable);
QUADS_WRITE(3, samples); // direction, density
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "glass_case.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    GlassCase c = loadCase(params.caseIndex);
    vec4 u = unitFloats(randomBits(i, params.caseIndex, bsdfBlock(0u), params.seed));
    vec3 l = sampleCase(c, u.xyz);
    storeQuad(samples, i, floatBitsToUint(vec4(l, evaluateCase(c, l).pdf)));
}
