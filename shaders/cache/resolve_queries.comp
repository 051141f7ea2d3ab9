#version 460
#extension GL_GOOGLE_include_directive : require
// Adds what the cache predicts at the ends of paths to their radiance. Each path has at most one query.
#include "lib/kernel.glsl"
#include "shared/cache.h"
#include "shared/network.h"

COUNTERS(0, counters);
QUADS_READ(1, queries);
QUADS_READ(2, queryWeights);
QUADS_READ(3, results);
layout(set = 0, binding = 4, std430) readonly buffer State { CacheState cacheState; };
layout(set = 0, binding = 5, std430) buffer Radiance { vec4 radiance[]; };
layout(push_constant) uniform Push { ResolveParams params; };
#include "cache/prediction.glsl"

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= counters[kQueryCounter]) return;
    uvec4 target = loadQuad(queryWeights, row);
    vec3 factor = REFLECTANCE(queries, row);
    vec3 predicted = toRadiance(uintBitsToFloat(loadQuad(results, row).rgb), params.factorise != 0u ? factor : vec3(1.0));
    radiance[target.w].rgb += uintBitsToFloat(target.rgb) * predicted;
}
