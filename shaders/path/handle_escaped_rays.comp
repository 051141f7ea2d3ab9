#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant handle_escaped_rays_cached WITH_CACHE
// Rays that left the scene: the environment's radiance, weighted against light sampling.
#include "lib/kernel.glsl"
#include "shared/path.h"
#include "shared/queue.h"

RECORDS_READ(0, rays);
RECORDS_READ(1, hits);
COUNTERS_READ(2, counters);
layout(set = 0, binding = 3, std430) buffer Radiance { vec4 radiance[]; };
RECORDS_READ(4, environment);
#ifdef WITH_CACHE
#define FIRST_TRAINING_BINDING 5
#include "path/training_light.glsl"
#endif
layout(push_constant) uniform Push { BounceParams params; };
#include "path/environment.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= counters[kRayCounter + params.queueParity]) return;
    if (loadRecord(hits, slot).y != kNoPrimitive) return;
    uint path = loadRecord(rays, slot * kRayRecords).w;
    vec4 ray = uintBitsToFloat(loadRecord(rays, slot * kRayRecords + 1u));
    vec3 beta = uintBitsToFloat(loadRecord(rays, slot * kRayRecords + 2u).rgb);

    vec2 uv = equirectOfDirection(ray.xyz);
    float weight = params.depth == 0u ? 1.0 : powerHeuristic(ray.w, environmentPdf(uv));
    vec3 emitted = environmentRadiance(uv);
    radiance[path].rgb += beta * emitted * weight;
#ifdef WITH_CACHE
    if (params.depth > 0u) gatherEmission(path, emitted * weight);
#endif
}
