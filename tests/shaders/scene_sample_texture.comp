#version 460
#extension GL_GOOGLE_include_directive : require
// Textures at given coordinates, as the path tracer's kernels read them.
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, geometry);
QUADS_READ(1, attributes);
QUADS_READ(2, materials);
QUADS_READ(3, textures);
HALVES_READ(4, texels);
QUADS_READ(5, queries); // u, v, texture code
QUADS_WRITE(6, results);
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "path/scene.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    uvec4 query = loadQuad(queries, i);
    vec2 uv = uintBitsToFloat(query.xy);
    storeQuad(results, i, floatBitsToUint(sampleTexture(query.z, TriangleAttributes(vec2[2](uv, uv), uvec3(0u), vec4(1.0)))));
}
