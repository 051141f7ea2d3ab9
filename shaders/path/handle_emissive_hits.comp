#version 460
#extension GL_GOOGLE_include_directive : require
#pragma folders path/taps/none path/light_samplers/power_or_tree
#pragma variant handle_emissive_hits_cached path/taps/radiance_cache
// Rays that hit an emissive triangle: its radiance, weighted against light sampling.
#include "lib/kernel.glsl"
#include "path/frame.glsl"
#include "shared/queue.h"

FRAME_CONSTANTS(0);
RECORDS_READ(1, rays);
RECORDS_READ(2, hits);
COUNTERS_READ(3, counters);
layout(set = 0, binding = 4, std430) buffer Radiance { vec4 radiance[]; };
RECORDS_READ(5, geometry);
RECORDS_READ(6, attributes);
RECORDS_READ(7, materials);
RECORDS_READ(8, textures);
HALVES_READ(9, texels);
RECORDS_READ(10, lights);
layout(push_constant) uniform Push { WaveParams params; };
#define TAP_BINDING 11
#include "tap_light.glsl"
#include "path/lights/triangles.glsl"
#include "lib/sampling.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= counters[kRayCounter + params.queueParity]) return;
    uvec4 hit = loadRecord(hits, slot);
    if (hit.y == kNoPrimitive) return;
    TriangleRecord tri = loadTriangle(hit.y);
    if (tri.light == kNoLight) return;
    uvec4 origin = loadRecord(rays, slot * kRayRecords);
    uint path = origin.w;
    vec4 ray = uintBitsToFloat(loadRecord(rays, slot * kRayRecords + 1u));
    uvec4 beta = loadRecord(rays, slot * kRayRecords + 2u);

    vec3 normal = cross(tri.e1, tri.e2);
    float doubleArea = length(normal);
    float cosine = -dot(normal, ray.xyz) / doubleArea; // > 0: the front is hit
    vec3 emitted = emittedRadiance(tri.material, cosine > 0.0,
                                   attributesFor(kEmissiveTexture, hit.y, uintBitsToFloat(hit.zw)));
    float weight = 1.0;
    if (params.depth > 0u) {
        Receiver receiver = Receiver(uintBitsToFloat(origin.xyz), decodeOctahedral(beta.w));
        float chance = lightChance(tri.light, receiver);
        float pdf = trianglePdf(chance, 0.5 * doubleArea, uintBitsToFloat(hit.x), abs(cosine));
        weight = powerHeuristic(ray.w, pdf);
    }
    radiance[path].rgb += uintBitsToFloat(beta.rgb) * emitted * weight;
    if (params.depth > 0u) hearEmission(path, emitted * weight);
}
