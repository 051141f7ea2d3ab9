#version 460
#extension GL_GOOGLE_include_directive : require
// Directional albedo by sampling. A case draws strata x strata jittered samples; one invocation sums a row of them.
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, cases);
QUADS_READ(1, reflectanceTable);
QUADS_WRITE(2, sums); // sum of f cos / pdf rgb, samples that count
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "bsdf_case.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    uint caseIndex = i / params.strata;
    uint row = i - caseIndex * params.strata;
    BsdfCase c = loadCase(caseIndex);
    vec4 sum = vec4(0.0);
    for (uint column = 0u; column < params.strata; ++column) {
        uint index = row * params.strata + column;
        vec4 u = unitFloats(randomBits(index, caseIndex, bsdfBlock(0u), params.seed));
        u.x = fract(float(index & 0xffffu) * 0.6180339887 + u.w / float(params.strata)); // the lobe: a Kronecker sequence
        u.yz = (vec2(column, row) + u.yz) / float(params.strata);
        vec3 l = sampleCase(c, min(u.xyz, vec3(0.99999994)));
        if (l.z <= 0.0) continue;
        BsdfValue value = evaluateCase(c, l);
        if (value.pdf > 0.0) sum += vec4(value.fCos / value.pdf, 1.0);
    }
    storeQuad(sums, i, floatBitsToUint(sum));
}
