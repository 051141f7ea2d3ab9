#version 460
#extension GL_GOOGLE_include_directive : require
// Directional albedo of glass by sampling. A case draws strata x strata jittered samples; one invocation sums a row.
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, cases);
QUADS_READ(1, reflectanceTable);
QUADS_READ(2, glassTable);
QUADS_WRITE(3, sums); // f cos / pdf of what is reflected, then of what is transmitted; largest of a channel
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "glass_case.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    uint caseIndex = i / params.strata;
    uint row = i - caseIndex * params.strata;
    GlassCase c = loadCase(caseIndex);
    vec4 reflected = vec4(0.0);
    vec4 transmitted = vec4(0.0);
    for (uint column = 0u; column < params.strata; ++column) {
        uint index = row * params.strata + column;
        vec4 u = unitFloats(randomBits(index, caseIndex, bsdfBlock(0u), params.seed));
        u.x = fract(float(index & 0xffffu) * 0.6180339887 + u.w / float(params.strata)); // the lobe: a Kronecker sequence
        u.yz = (vec2(column, row) + u.yz) / float(params.strata);
        vec3 l = sampleCase(c, min(u.xyz, vec3(0.99999994)));
        BsdfValue value = evaluateCase(c, l);
        if (value.pdf <= 0.0) continue;
        vec4 weight = vec4(value.fCos / value.pdf, 0.0);
        weight.w = maxComponent(weight.rgb);
        if (l.z > 0.0) reflected = vec4(reflected.rgb + weight.rgb, max(reflected.w, weight.w));
        else transmitted = vec4(transmitted.rgb + weight.rgb, max(transmitted.w, weight.w));
    }
    storeQuad(sums, 2u * i, floatBitsToUint(reflected));
    storeQuad(sums, 2u * i + 1u, floatBitsToUint(transmitted));
}
