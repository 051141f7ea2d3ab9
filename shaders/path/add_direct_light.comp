#version 460
#extension GL_GOOGLE_include_directive : require
#pragma folders path/taps/none
#pragma variant add_direct_light_cached path/taps/radiance_cache
// Adds the light samples whose shadow rays met nothing. Each path has at most one a bounce: no two items share a path.
#include "lib/kernel.glsl"
#include "shared/queue.h"

QUADS_READ(0, shadowRays);
WORDS_READ(1, visibility);
COUNTERS_READ(2, counters);
layout(set = 0, binding = 3, std430) buffer Radiance { vec4 radiance[]; };
#define TAP_BINDING 4
#include "tap_light.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= counters[kShadowRayCounter]) return;
    if (loadWord(visibility, slot) == 0u) return;
    uint path = loadQuad(shadowRays, slot * kShadowRayQuads + 1u).w;
    radiance[path].rgb += uintBitsToFloat(loadQuad(shadowRays, slot * kShadowRayQuads + 2u).rgb);
    hearDirectLight(path);
}
