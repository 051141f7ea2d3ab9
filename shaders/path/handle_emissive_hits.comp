#version 460
#extension GL_GOOGLE_include_directive : require
#pragma folders path/taps/none path/light_samplers/power_or_tree
#pragma variant handle_emissive_hits_cached path/taps/radiance_cache
// Rays that hit an emissive triangle: its radiance, weighted against light sampling.
#include "lib/kernel.glsl"
#include "path/frame.glsl"
#include "shared/queue.h"

FRAME_CONSTANTS(0);
QUADS_READ(1, rays);
QUADS_READ(2, hits);
COUNTERS_READ(3, counters);
layout(set = 0, binding = 4, std430) buffer Radiance { vec4 radiance[]; };
QUADS_READ(5, geometry);
QUADS_READ(6, attributes);
QUADS_READ(7, materials);
QUADS_READ(8, textures);
HALVES_READ(9, texels);
QUADS_READ(10, lights);
QUADS_READ(11, passages);
layout(push_constant) uniform Push { WaveParams params; };
#define TAP_BINDING 12
#include "tap_light.glsl"
#include "path/lights/triangles.glsl"
#include "path/passage.glsl"
#include "lib/sampling.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= counters[kRayCounter + params.queueParity]) return;
    uvec4 hit = loadQuad(hits, slot);
    if (hit.y == kNoPrimitive) return;
    TriangleGeometry tri = loadTriangle(hit.y);
    if (tri.light == kNoLight) return;
    uvec4 origin = loadQuad(rays, slot * kRayQuads);
    uint path = origin.w;
    vec4 ray = uintBitsToFloat(loadQuad(rays, slot * kRayQuads + 1u));
    uvec4 beta = loadQuad(rays, slot * kRayQuads + 2u);

    vec3 normal = cross(tri.e1, tri.e2);
    float doubleArea = length(normal);
    float cosine = -dot(normal, ray.xyz) / doubleArea; // > 0: the front is hit
    vec3 emitted = emittedRadiance(tri.material, cosine > 0.0,
                                   attributesFor(kEmissionAttributes, hit.y, uintBitsToFloat(hit.zw)));
    emitted *= passageOf(path);
    float weight = 1.0;
    if (params.depth > 0u) {
        Receiver receiver = receiverOf(uintBitsToFloat(origin.xyz), beta.w);
        float chance = lightChance(tri.light, receiver);
        float pdf = trianglePdf(chance, 0.5 * doubleArea, uintBitsToFloat(hit.x), abs(cosine));
        weight = powerHeuristic(ray.w, pdf);
    }
    radiance[path].rgb += uintBitsToFloat(beta.rgb) * emitted * weight;
    if (params.depth > 0u) hearEmission(path, emitted * weight);
}
