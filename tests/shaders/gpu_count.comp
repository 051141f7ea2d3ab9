// Counts its invocations, and its workgroups as the group counts of an indirect dispatch.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(push_constant) uniform Params { uint count; };
COUNTERS(0, counters);
COUNTERS(1, arguments);

void main() {
    if (gl_GlobalInvocationID.x >= count) return;
    atomicAdd(counters[0], 1);
    atomicAdd(arguments[0], gl_LocalInvocationID.x == 0 ? 1 : 0);
    arguments[1] = 1;
    arguments[2] = 1;
}
