#version 460
#extension GL_GOOGLE_include_directive : require
// Surfaces at given points of triangles, seen from given directions.
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, geometry);
QUADS_READ(1, attributes);
QUADS_READ(2, materials);
QUADS_READ(3, textures);
HALVES_READ(4, texels);
QUADS_READ(5, queries);  // 2 each: direction to the viewer, primitive; barycentrics
QUADS_WRITE(6, results); // 5 each: position; geometric normal; shading normal, roughness; diffuse; F0, F90
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "path/surface.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    uvec4 view = loadQuad(queries, 2u * i);
    vec2 b = uintBitsToFloat(loadQuad(queries, 2u * i + 1u).xy);
    Surface s = loadSurface(view.w, b, uintBitsToFloat(view.xyz), kNoMedia);
    storeQuad(results, 5u * i, floatBitsToUint(vec4(s.position, 0.0)));
    storeQuad(results, 5u * i + 1u, floatBitsToUint(vec4(s.geometricNormal, 0.0)));
    storeQuad(results, 5u * i + 2u, floatBitsToUint(vec4(s.shadingNormal, s.roughness)));
    storeQuad(results, 5u * i + 3u, floatBitsToUint(vec4(s.bsdf.diffuse, 0.0)));
    storeQuad(results, 5u * i + 4u, floatBitsToUint(vec4(s.bsdf.specularF0, s.bsdf.specularF90)));
}
