#version 460
#extension GL_GOOGLE_include_directive : require
#pragma folders path/transparency/none
#pragma variant intersect_closest_transparent path/transparency/some
// Nearest hit of every ray of the queue. A lane whose ray has ended takes the next of its subgroup's rays.
#include "lib/kernel.glsl"
#include "shared/trace.h"

QUADS_READ(0, bvh);
QUADS_READ(1, rays);
COUNTERS_READ(2, counters);
QUADS_WRITE(3, hits);
layout(push_constant) uniform Push { TraceParams params; };

#include "lib/bvh.glsl"
#include "closest_passage.glsl"

Traversal takeRay(uint slot) {
    uvec4 origin = loadQuad(rays, slot * kRayQuads);
    uvec4 direction = loadQuad(rays, slot * kRayQuads + 1u);
    return beginTraversal(params.root, uintBitsToFloat(origin.xyz), uintBitsToFloat(direction.xyz), kUnbounded);
}

void storeHit(uint slot, Traversal ray) {
    storeQuad(hits, slot, uvec4(floatBitsToUint(ray.tMax), ray.primitive, floatBitsToUint(vec2(ray.u, ray.v))));
}

void main() {
    uint slot = firstSlot();
    uint end = min(counters[params.counter], slot - gl_SubgroupInvocationID + kSubgroupSize * kRaysPerLane);
    bool working = slot < end;
    Traversal ray;
    if (working) ray = takeRay(slot);
    while (working) {
        traversalStep(ray, kNearestHit);
        if (ray.item == kEndOfTraversal && !passes(slot, ray)) {
            storeHit(slot, ray);
            slot += kSubgroupSize;
            working = slot < end;
            if (working) ray = takeRay(slot);
        }
    }
}
