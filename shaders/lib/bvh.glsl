// Traversal of the hierarchy of shared/bvh.h, one ray a lane, in steps that are the same for every lane: three
// loads, four boxes and a triangle under selects. The including kernel has declared QUADS_READ(0, bvh).
//
// Measured on lavapipe with 8 lanes, and left out: a stack entry a child, three pushes a step (up to 6 % slower, under
// branches 15 %); 8 steps between refills (5-14 %), 8 rays a lane (up to 10 %); leaves of two triangles, uniform texel
// buffers, workgroups of 8, 16 or 64 (no difference).
#include "lib/intersect.glsl"
#include "shared/bvh.h"
#include "shared/queue.h"

struct Traversal {
    vec3 origin;
    vec3 direction;
    vec3 reciprocal; // of the direction
    float tMin;      // hits lie beyond it
    float tMax;      // nearest hit so far
    uint primitive;  // of that hit; kNoPrimitive = none
    bool isTransparent; // of that hit: it may let light straight on through
    float u, v;
    uint item;  // to be visited next; kEndOfTraversal = none is left
    uint group; // the innermost group; the others are on the stack
    uint depth; // groups on the stack, its empty bottom included
};

// With which hit a traversal ends.
const uint kNearestHit = 0u;
const uint kAnyHit = 1u;
const uint kAnyOpaqueHit = 2u; // else with the nearest

const float kUnbounded = 1e30;
const uint kEndOfTraversal = 0xffffffffu;
const uint kEmptyGroup = 0xffffffffu;

// Memory of the groups. Entry 0 is an empty group: the end.
uint groupStack[kTraversalStack];

// This lane's first slot of the queue; it takes every kSubgroupSize-th up to its subgroup's last.
uint firstSlot() {
    uint subgroup = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID;
    return subgroup * kSubgroupSize * kRaysPerLane + gl_SubgroupInvocationID;
}

Traversal beginTraversal(uint root, vec3 origin, vec3 direction, float tMax) {
    bool traceable = isTraceable(origin, direction);
    Traversal ray;
    ray.origin = traceable ? origin : vec3(0.0);
    ray.direction = traceable ? direction : vec3(1.0);
    ray.reciprocal = safeReciprocal(ray.direction);
    ray.tMin = 0.0;
    ray.tMax = traceable ? tMax : -1.0;
    ray.primitive = kNoPrimitive;
    ray.isTransparent = false;
    ray.u = 0.0;
    ray.v = 0.0;
    ray.item = root;
    ray.group = kEmptyGroup;
    ray.depth = 1u;
    groupStack[0] = kEmptyGroup;
    return ray;
}

// Goes on beyond the hit with which the ray has ended, up to tMax.
void resumeTraversal(inout Traversal ray, uint root, float tMax) {
    ray.tMin = ray.tMax;
    ray.tMax = tMax;
    ray.primitive = kNoPrimitive;
    ray.item = root;
    ray.group = kEmptyGroup;
    ray.depth = 1u;
    groupStack[0] = kEmptyGroup;
}

// Tests a triangle item; `isTriangle` false gives it zero edges. (Not the node's words: read as floats they are
// often denormal, and cost an x86 core a hundred cycles each.)
bool visitTriangle(inout Traversal ray, bool isTriangle, uvec4 a, uvec4 b, uvec4 c) {
    vec3 e1 = uintBitsToFloat(isTriangle ? b.xyz : uvec3(0u));
    vec3 e2 = uintBitsToFloat(isTriangle ? uvec3(b.w, c.xy) : uvec3(0u));
    float margin = uintBitsToFloat(isTriangle ? c.z : 0u);
    float t, u, v;
    bool hit = intersectTriangle(ray.origin, ray.direction, ray.tMin, ray.tMax, uintBitsToFloat(a.xyz), e1, e2, margin, t, u, v);
    ray.tMax = hit ? t : ray.tMax;
    ray.u = hit ? u : ray.u;
    ray.v = hit ? v : ray.v;
    ray.primitive = hit ? a.w & kPrimitiveMask : ray.primitive;
    ray.isTransparent = hit ? c.w != 0u : ray.isTransparent;
    return hit;
}

// Children hit, nearest first: entry distance with the child's number in its lowest bits, all ones where missed. A
// triangle item has no children present.
uvec4 visitNode(Traversal ray, uvec4 a, uvec4 b, uvec4 c) {
    ivec4 enter, leave;
    intersectBoxes(a, b, c, ray.origin, ray.reciprocal, ray.tMax, enter, leave);
    uvec4 key = (uvec4(enter) & ~kChildMask) | uvec4(0u, 1u, 2u, 3u);
    key = mix(uvec4(kEndOfTraversal), key, lessThanEqual(enter, leave));
    key = mix(uvec4(kEndOfTraversal), key, notEqual(c.w & uvec4(1u, 2u, 4u, 8u), uvec4(0u)));
    return sorted(key);
}

// Visits ray.item and chooses the next one.
void traversalStep(inout Traversal ray, const uint lastHit) {
    uint quad = ray.item * kItemQuads;
    uvec4 a = loadQuad(bvh, quad);
    uvec4 b = loadQuad(bvh, quad + 1u);
    uvec4 c = loadQuad(bvh, quad + 2u);
    bool isTriangle = (a.w & kTriangleItem) != 0u;
    uvec4 key = visitNode(ray, a, b, c);
    bool hit = visitTriangle(ray, isTriangle, a, b, c);

    // The other children become the innermost group. The store is unconditional: above the top it does no harm,
    // and a masked one costs a branch a lane.
    bool others = key.y != kEndOfTraversal;
    groupStack[ray.depth] = ray.group;
    ray.depth += others && (ray.group & kChildMask) != kNoChild ? 1u : 0u;
    uint group = c.z | (key.y & kChildMask) | (key.z & kChildMask) << kChildBits |
                 (key.w & kChildMask) << (2u * kChildBits);
    ray.group = others ? group : ray.group;

    bool back = key.x == kEndOfTraversal;
    uint next = (c.z >> kGroupBits) + (key.x & kChildMask);
    uint outer = groupStack[ray.depth - 1u];
    bool pop = back && (ray.group & kChildMask) == kNoChild;
    ray.group = pop ? outer : ray.group;
    ray.depth -= pop ? 1u : 0u;
    bool end = (back && (ray.group & kChildMask) == kNoChild) || (lastHit == kAnyHit && hit) ||
               (lastHit == kAnyOpaqueHit && hit && !ray.isTransparent);
    next = back ? (ray.group >> kGroupBits) + (ray.group & kChildMask) : next;
    uint rest = (ray.group & ~kGroupMask) | ((ray.group & kGroupMask) >> kChildBits) | kLastChild;
    ray.group = back ? rest : ray.group;
    ray.item = end ? kEndOfTraversal : next;
}
