#version 460
#extension GL_GOOGLE_include_directive : require
// After a change of the radiance's scale: the network's last layer, and its average, follow, so that predictions mean the
// same radiance as before. Exact, since scales are powers of two.
#include "lib/kernel.glsl"
#include "shared/cache.h"

layout(set = 0, binding = 0, std430) readonly buffer State { CacheState cacheState; };
layout(set = 0, binding = 1, std430) buffer Values { vec4 values[]; };
layout(set = 0, binding = 2, std430) buffer Averages { vec4 averages[]; };
layout(push_constant) uniform Push { RescaleParams params; };

void main() {
    uint quad = gl_GlobalInvocationID.x;
    if (quad >= params.quads || cacheState.rescaling == 1.0) return;
    values[quad] *= cacheState.rescaling;
    averages[quad] *= cacheState.rescaling;
}
