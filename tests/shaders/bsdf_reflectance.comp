#version 460
#extension GL_GOOGLE_include_directive : require
// Look-ups in the reflectance table.
#include "lib/kernel.glsl"
#include "harness.h"

RECORDS_READ(0, queries); // cosine, roughness
RECORDS_READ(1, reflectanceTable);
RECORDS_WRITE(2, results); // A, B, C
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "path/reflectance.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    vec2 query = uintBitsToFloat(loadRecord(queries, i).xy);
    storeRecord(results, i, floatBitsToUint(vec4(reflectanceAt(query.x, query.y), 0.0)));
}
