// Choice of an emissive triangle by what it may send to a point: Conty Estevez and Kulla 2018, "Importance Sampling of Many
// Lights with Adaptive Tree Splitting". Bindings: `lights` (records); `params` is a BounceParams.
#ifndef IRRADIA_PATH_LIGHT_TREE_GLSL
#define IRRADIA_PATH_LIGHT_TREE_GLSL
#include "lib/math.glsl"
#include "lib/rng.glsl"
#include "shared/scene.h"

struct LightBranch {
    float importance;
    uint child;
};

// Power over squared distance, times the largest cosine between a normal in the node's cone and a direction to the point
// from within its sphere (eqs. 2 to 4).
LightBranch lightBranch(uint node, vec3 point) {
    uint at = params.lightCount + node * kLightNodeRecords;
    vec4 sphere = uintBitsToFloat(loadRecord(lights, at));
    uvec4 r = loadRecord(lights, at + 1u);
    vec3 to = point - sphere.xyz;
    float squared = dot(to, to);
    float squaredRadius = sphere.w * sphere.w;
    float cosAxis = clamp(dot(decodeOctahedral(r.x), to) * inversesqrt(max(squared, 1e-30)), -1.0, 1.0);
    float sinAxis = sqrt(1.0 - cosAxis * cosAxis);
    float cosSpread = uintBitsToFloat(r.y);
    float sinSpread = sqrt(max(1.0 - cosSpread * cosSpread, 0.0));
    float squaredSin = squaredRadius / max(squared, 1e-30); // of the angle that the sphere's radius subtends
    float cosSphere = sqrt(max(1.0 - squaredSin, 0.0));
    float sinSphere = sqrt(min(squaredSin, 1.0));
    // The angle to the axis less the cone's, then less the sphere's, neither below 0.
    bool inCone = cosAxis >= cosSpread;
    float cosine = inCone ? 1.0 : cosAxis * cosSpread + sinAxis * sinSpread;
    float sine = inCone ? 0.0 : sinAxis * cosSpread - cosAxis * sinSpread;
    cosine = cosine >= cosSphere ? 1.0 : cosine * cosSphere + sine * sinSphere;
    if (squared <= squaredRadius) cosine = 1.0; // within the sphere
    return LightBranch(uintBitsToFloat(r.z) * max(cosine, 0.0) / max(max(squared, squaredRadius), 1e-30), r.w);
}

struct LightPair {
    float chanceOfFirst;
    uint first;
    uint second;
    bool reaches; // some light of the pair does
};

LightPair lightPair(uint child, vec3 point) {
    LightBranch a = lightBranch(child, point);
    LightBranch b = lightBranch(child + 1u, point);
    float sum = a.importance + b.importance;
    return LightPair(a.importance / max(sum, 1e-37), a.child, b.child, sum > 1e-37);
}

uint rootChild() { return loadRecord(lights, params.lightCount + 1u).w; }

struct LightChoice {
    uint light;
    float chance; // 0 = none of the lights reaches the point
};

LightChoice chooseLight(vec3 point, uint random) {
    uint child = rootChild();
    float chance = 1.0;
    while ((child & kLightLeaf) == 0u) {
        LightPair pair = lightPair(child, point);
        random = pcg(random);
        bool first = unitFloat(random) < pair.chanceOfFirst;
        chance *= first ? pair.chanceOfFirst : 1.0 - pair.chanceOfFirst;
        child = first ? pair.first : pair.second;
        if (!pair.reaches) return LightChoice(0u, 0.0);
    }
    return LightChoice(child & ~kLightLeaf, chance);
}

// Of chooseLight to choose this light.
float chanceOfLight(uint light, vec3 point) {
    uint trail = loadRecord(lights, light).x;
    uint child = rootChild();
    float chance = 1.0;
    while ((child & kLightLeaf) == 0u) {
        LightPair pair = lightPair(child, point);
        bool first = (trail & 1u) == 0u;
        chance *= !pair.reaches ? 0.0 : (first ? pair.chanceOfFirst : 1.0 - pair.chanceOfFirst);
        child = first ? pair.first : pair.second;
        trail >>= 1u;
    }
    return chance;
}

#endif
