#version 460
#extension GL_GOOGLE_include_directive : require
// Directions drawn from one case, and their densities (0 = nothing is reflected).
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, cases);
QUADS_READ(1, reflectanceTable);
QUADS_WRITE(2, samples); // direction, density
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "bsdf_case.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    BsdfCase c = loadCase(params.caseIndex);
    vec4 u = unitFloats(randomBits(i, params.caseIndex, bsdfBlock(0u), params.seed));
    vec3 l = sampleCase(c, u.xyz);
    float pdf = l.z > 0.0 ? evaluateCase(c, l).pdf : 0.0;
    storeQuad(samples, i, floatBitsToUint(vec4(l, pdf)));
}
