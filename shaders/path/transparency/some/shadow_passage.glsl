// Shadow rays lose a share of their light to each surface that lets some straight on through.
QUADS_WRITE(3, visibility);
QUADS_READ(4, geometry);
QUADS_READ(5, attributes);
QUADS_READ(6, materials);
QUADS_READ(7, textures);
HALVES_READ(8, texels);
#include "path/transparency/see_through.glsl"

const uint kShadowingHit = kAnyOpaqueHit;

vec3 left = vec3(1.0); // of this lane's ray

bool passes(uint slot, inout Traversal ray) {
    if (ray.primitive == kNoPrimitive || !ray.isTransparent) return false;
    left *= seeThrough(ray.primitive, vec2(ray.u, ray.v), ray.direction).passing;
    bool goesOn = maxComponent(left) > 0.0;
    if (goesOn) resumeTraversal(ray, params.root, uintBitsToFloat(loadQuad(rays, slot * kShadowRayQuads).w));
    return goesOn;
}

void storeVisibility(uint slot, Traversal ray) {
    storeQuad(visibility, slot, uvec4(floatBitsToUint(ray.primitive == kNoPrimitive ? left : vec3(0.0)), 0u));
    left = vec3(1.0);
}
