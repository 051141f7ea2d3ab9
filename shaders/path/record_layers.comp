#version 460
#extension GL_GOOGLE_include_directive : require
// The first hits of each pixel for the AOV layers: albedo, shading normal, position, depth, summed over samples in their order.
#include "lib/kernel.glsl"
#include "path/frame.glsl"
#include "shared/queue.h"

FRAME_CONSTANTS(0);
QUADS_READ(1, rays);
QUADS_READ(2, hits);
layout(set = 0, binding = 3, std430) buffer Layers { vec4 layers[]; };
QUADS_READ(4, geometry);
QUADS_READ(5, attributes);
QUADS_READ(6, materials);
QUADS_READ(7, textures);
HALVES_READ(8, texels);
layout(push_constant) uniform Push { WaveParams params; };
#include "path/surface.glsl"

void addHit(uint slot, inout vec4 sums[kLayerVectors]) {
    uvec4 hit = loadQuad(hits, slot);
    if (hit.y == kNoPrimitive) return;
    vec3 view = -uintBitsToFloat(loadQuad(rays, slot * kRayQuads + 1u).xyz);
    Surface s = loadSurface(hit.y, uintBitsToFloat(hit.zw), view, kNoMedia);
    vec3 albedo = s.bsdf.diffuse + s.bsdf.specularF0;
    if (s.isGlass) albedo += s.glass.tint;
    float depth = dot(s.position - camera.position.xyz, camera.forward.xyz);
    sums[0] += vec4(albedo, 1.0);
    sums[1] += vec4(s.shadingNormal, depth);
    sums[2] += vec4(s.position, 0.0);
}

// Camera rays stand in the queue in the order of their paths.
void main() {
    uint pixel = gl_GlobalInvocationID.x;
    if (pixel >= params.paths >> params.log2Samples) return;
    uint at = pixel * kLayerVectors;
    vec4 sums[kLayerVectors] = vec4[](layers[at], layers[at + 1u], layers[at + 2u]);
    uint slot = pixel << params.log2Samples, end = slot + (1u << params.log2Samples);
    do addHit(slot, sums);
    while (++slot < end);
    [[unroll]] for (uint i = 0u; i < kLayerVectors; ++i) layers[at + i] = sums[i];
}
