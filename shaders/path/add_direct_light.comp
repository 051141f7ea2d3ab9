#version 460
#extension GL_GOOGLE_include_directive : require
#pragma folders path/taps/none path/transparency/none
#pragma variant add_direct_light_cached path/taps/radiance_cache
#pragma variant add_filtered_light path/transparency/some
#pragma variant add_filtered_light_cached path/taps/radiance_cache path/transparency/some
// Adds what arrives of the light samples: all of those whose shadow rays met nothing, or the share that was let through. Each
// path has at most one a bounce: no two items share a path.
#include "lib/kernel.glsl"
#include "lib/math.glsl"
#include "shared/queue.h"

QUADS_READ(0, shadowRays);
#include "arriving_share.glsl"
COUNTERS_READ(2, counters);
layout(set = 0, binding = 3, std430) buffer Radiance { vec4 radiance[]; };
#define TAP_BINDING 4
#include "tap_light.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= counters[kShadowRayCounter]) return;
    vec3 share = arrivingShare(slot);
    if (maxComponent(share) == 0.0) return;
    uint path = loadQuad(shadowRays, slot * kShadowRayQuads + 1u).w;
    radiance[path].rgb += uintBitsToFloat(loadQuad(shadowRays, slot * kShadowRayQuads + 2u).rgb) * share;
    hearDirectLight(path, share);
}
