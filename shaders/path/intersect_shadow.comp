#version 460
#extension GL_GOOGLE_include_directive : require
#pragma folders path/transparency/none
#pragma variant intersect_shadow_transparent path/transparency/some
// Whether anything lies on each shadow ray of the queue. A lane whose ray has ended takes the next of its subgroup's.
#include "lib/kernel.glsl"
#include "shared/trace.h"

QUADS_READ(0, bvh);
QUADS_READ(1, rays);
COUNTERS_READ(2, counters);
layout(push_constant) uniform Push { TraceParams params; };

#include "lib/bvh.glsl"
#include "shadow_passage.glsl"

Traversal takeRay(uint slot) {
    uvec4 origin = loadQuad(rays, slot * kShadowRayQuads);
    uvec4 direction = loadQuad(rays, slot * kShadowRayQuads + 1u);
    return beginTraversal(params.root, uintBitsToFloat(origin.xyz), uintBitsToFloat(direction.xyz),
                          uintBitsToFloat(origin.w));
}

void main() {
    uint slot = firstSlot();
    uint end = min(counters[params.counter], slot - gl_SubgroupInvocationID + kSubgroupSize * kRaysPerLane);
    bool working = slot < end;
    Traversal ray;
    if (working) ray = takeRay(slot);
    while (working) {
        traversalStep(ray, kShadowingHit);
        if (ray.item == kEndOfTraversal && !passes(slot, ray)) {
            storeVisibility(slot, ray);
            slot += kSubgroupSize;
            working = slot < end;
            if (working) ray = takeRay(slot);
        }
    }
}
