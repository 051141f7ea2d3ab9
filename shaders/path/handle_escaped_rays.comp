#version 460
#extension GL_GOOGLE_include_directive : require
#pragma folders path/taps/none path/light_samplers/power_or_tree
#pragma variant handle_escaped_rays_cached path/taps/radiance_cache
// Rays that left the scene: the environment's radiance, weighted against light sampling.
#include "lib/kernel.glsl"
#include "path/frame.glsl"
#include "shared/queue.h"

FRAME_CONSTANTS(0);
QUADS_READ(1, rays);
QUADS_READ(2, hits);
COUNTERS_READ(3, counters);
layout(set = 0, binding = 4, std430) buffer Radiance { vec4 radiance[]; };
QUADS_READ(5, lights);
QUADS_READ(6, environment);
QUADS_READ(7, passages);
layout(push_constant) uniform Push { WaveParams params; };
#define TAP_BINDING 8
#include "tap_light.glsl"
#include "path/lights/environment.glsl"
#include "path/passage.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= counters[kRayCounter + params.queueParity]) return;
    if (loadQuad(hits, slot).y != kNoPrimitive) return;
    uint path = loadQuad(rays, slot * kRayQuads).w;
    vec4 ray = uintBitsToFloat(loadQuad(rays, slot * kRayQuads + 1u));
    vec3 beta = uintBitsToFloat(loadQuad(rays, slot * kRayQuads + 2u).rgb);

    vec2 uv = equirectOfDirection(ray.xyz);
    float weight = params.depth == 0u ? 1.0 : powerHeuristic(ray.w, environmentPdf(uv));
    vec3 emitted = environmentRadiance(uv) * passageOf(path);
    radiance[path].rgb += beta * emitted * weight;
    if (params.depth > 0u) hearEmission(path, emitted * weight);
}
