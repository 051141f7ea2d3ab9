#version 460
#extension GL_GOOGLE_include_directive : require
// Look-ups in the table of what rough glass loses.
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, queries); // cosine, alpha, eta, 1 of sheets
QUADS_READ(1, glassTable);
QUADS_WRITE(2, results); // 1 - E, its mean
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "path/glass_table.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    vec4 query = uintBitsToFloat(loadQuad(queries, i));
    float loss = glassLoss(query.x, query.y, query.z);
    storeQuad(results, i, floatBitsToUint(vec4(loss, glassMeanLoss(query.y, query.z, query.w > 0.0), 0.0, 0.0)));
}
