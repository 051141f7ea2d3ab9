#version 460
#extension GL_GOOGLE_include_directive : require
// Look-ups in the reflectance table.
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, queries); // cosine, roughness
QUADS_READ(1, reflectanceTable);
QUADS_WRITE(2, results); // A, B, C
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "path/reflectance.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    vec2 query = uintBitsToFloat(loadQuad(queries, i).xy);
    storeQuad(results, i, floatBitsToUint(vec4(reflectanceAt(query.x, query.y), 0.0)));
}
