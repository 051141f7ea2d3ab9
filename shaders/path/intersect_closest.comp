#version 460
#extension GL_GOOGLE_include_directive : require
// Nearest hit of every ray of the queue. A lane whose ray has ended takes the next of its subgroup's rays.
#include "lib/kernel.glsl"
#include "shared/trace.h"

RECORDS_READ(0, bvh);
RECORDS_READ(1, rays);
COUNTERS_READ(2, counters);
RECORDS_WRITE(3, hits);
layout(push_constant) uniform Push { TraceParams params; };

#include "lib/bvh.glsl"

Traversal takeRay(uint slot) {
    uvec4 origin = loadRecord(rays, slot * kRayRecords);
    uvec4 direction = loadRecord(rays, slot * kRayRecords + 1u);
    return beginTraversal(params.root, uintBitsToFloat(origin.xyz), uintBitsToFloat(direction.xyz), kUnbounded);
}

void storeHit(uint slot, Traversal ray) {
    storeRecord(hits, slot, uvec4(floatBitsToUint(ray.tMax), ray.primitive, floatBitsToUint(vec2(ray.u, ray.v))));
}

void main() {
    uint slot = firstSlot();
    uint end = min(counters[params.counter], slot - gl_SubgroupInvocationID + kSubgroupSize * kRaysPerLane);
    bool working = slot < end;
    Traversal ray;
    if (working) ray = takeRay(slot);
    while (working) {
        traversalStep(ray, false);
        if (ray.item == kEndOfTraversal) {
            storeHit(slot, ray);
            slot += kSubgroupSize;
            working = slot < end;
            if (working) ray = takeRay(slot);
        }
    }
}
