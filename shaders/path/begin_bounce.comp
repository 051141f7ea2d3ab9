#version 460
#extension GL_GOOGLE_include_directive : require
// Opens a step of the loop over bounces: indirect arguments from the number of rays, empty queues for what it makes.
#include "lib/kernel.glsl"
#include "shared/path.h"
#include "shared/queue.h"

COUNTERS(0, counters);
COUNTERS(1, arguments);
layout(push_constant) uniform Push { BeginBounceParams params; };

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    uint count = counters[kRayCounter + params.parity];
    arguments[kTraceArguments] = (count + params.raysPerTraceGroup - 1u) / params.raysPerTraceGroup;
    arguments[kTraceArguments + 1u] = 1u;
    arguments[kTraceArguments + 2u] = 1u;
    arguments[kItemArguments] = (count + params.itemsPerGroup - 1u) / params.itemsPerGroup;
    arguments[kItemArguments + 1u] = 1u;
    arguments[kItemArguments + 2u] = 1u;
    uint carry;
    uint traced = count * params.areTraced + counters[kShadowRayCounter];
    counters[kTracedRays] = uaddCarry(counters[kTracedRays], traced, carry);
    counters[kTracedRaysHigh] += carry;
    counters[kRayCounter + 1u - params.parity] = 0u;
    counters[kShadowRayCounter] = 0u;
}
