#version 460
#extension GL_GOOGLE_include_directive : require
// Textures at given coordinates, as the path tracer's kernels read them.
#include "lib/kernel.glsl"
#include "harness.h"

RECORDS_READ(0, geometry);
RECORDS_READ(1, attributes);
RECORDS_READ(2, materials);
RECORDS_READ(3, textures);
HALVES_READ(4, texels);
RECORDS_READ(5, queries); // u, v, texture code
RECORDS_WRITE(6, results);
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "path/scene.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    uvec4 query = loadRecord(queries, i);
    vec2 uv = uintBitsToFloat(query.xy);
    storeRecord(results, i, floatBitsToUint(sampleTexture(query.z, TriangleAttributes(vec2[2](uv, uv), uvec3(0u)))));
}
