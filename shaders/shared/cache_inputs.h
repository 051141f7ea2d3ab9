// What the cache knows of a vertex, the inputs of its network, in this order:
//   position 3    (p - boxLow) * boxScale: the scene box's longest edge has length 1
//   direction 2   towards which light is scattered: (theta, phi) of sphericalCoordinates
//   normal 2      shading normal, likewise
//   roughness 1   1 - exp(-roughness)
//   alpha 3       diffuse reflectance: base colour (1 - metallic) (1 - transmission)
//   beta 3        specular reflectance: mix(F0, base colour, metallic) + base colour (1 - metallic) transmission
// stored as kCacheInputQuads quads, the last two values zero. alpha + beta is the reflectance by which predictions are
// multiplied where the cache factorises it.
#ifndef IRRADIA_SHARED_CACHE_INPUTS_H
#define IRRADIA_SHARED_CACHE_INPUTS_H
#include "shared/types.h"
SHARED_BEGIN

SHARED_CONST uint kCacheInputs = 14u;
SHARED_CONST uint kCacheInputQuads = 4u;
SHARED_CONST uint kCacheInputBytes = kCacheInputQuads * 16u; // of a row
SHARED_CONST uint kCacheOutputs = 3u;


struct CacheInputs {
    vec4 quads[kCacheInputQuads];
};

SHARED_INLINE CacheInputs packCacheInputs(vec3 position, vec2 direction, vec2 normal, float roughness, vec3 alpha, vec3 beta) {
    CacheInputs i;
    i.quads[0] = vec4(position, direction.x);
    i.quads[1] = vec4(direction.y, normal, roughness);
    i.quads[2] = vec4(alpha, beta.r);
    i.quads[3] = vec4(beta.g, beta.b, 0.0f, 0.0f);
    return i;
}

// alpha + beta, from the third quad and the fourth.
SHARED_INLINE vec3 cacheReflectance(vec4 quad2, vec4 quad3) {
    return vec3(quad2.r, quad2.g, quad2.b) + vec3(quad2.a, quad3.r, quad3.g);
}

SHARED_END
#endif
