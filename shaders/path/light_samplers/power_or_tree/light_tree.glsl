// Choice of a local light by what it may send to a receiver: Conty Estevez and Kulla 2018, "Importance Sampling of Many
// Lights with Adaptive Tree Splitting". Bindings: `lights` (quads); `frame` is FrameConstants.
#ifndef IRRADIA_PATH_LIGHT_TREE_GLSL
#define IRRADIA_PATH_LIGHT_TREE_GLSL
#include "lib/math.glsl"
#include "lib/rng.glsl"
#include "path/light_choice.glsl"
#include "path/needs.glsl"
#include "path/sampler.glsl"
#include "shared/scene.h"

struct LightBranch {
    float importance;
    uint child;
};

// Cosine of an angle less another, 1 where that is below 0; both from 0 to pi.
float cosOfExcess(float cosA, float cosB) {
    float product = max((1.0 - cosA * cosA) * (1.0 - cosB * cosB), 0.0);
    return cosA >= cosB ? 1.0 : cosA * cosB + sqrt(product);
}

// Cosines of a node's angles: those of its cone, and how far light reaches beyond it.
vec2 cosinesOfCone(uint code) {
    if (!kHasPoints) return vec2(uintBitsToFloat(code), 0.0);
    vec2 sines = unpackUnorm2x16(code);
    return 1.0 - 2.0 * sines * sines;
}

// Power over squared distance, times two cosines at their largest for a direction to the point from within the node's
// sphere: to a normal in the node's cone, none where light does not reach so far beyond it, and to the receiver's normal:
// the paper's importance. Of points it is not cut where their range ends.
LightBranch lightBranch(uint node, Receiver receiver) {
    uint at = frame.lightCount + node * kLightNodeQuads;
    vec4 sphere = uintBitsToFloat(loadQuad(lights, at));
    uvec4 r = loadQuad(lights, at + 1u);
    vec3 to = receiver.point - sphere.xyz;
    float squared = dot(to, to);
    float squaredRadius = sphere.w * sphere.w;
    float scale = inversesqrt(max(squared, 1e-37));
    float cosSphere = sqrt(max(1.0 - squaredRadius * scale * scale, 0.0)); // of the angle that its radius subtends
    float cosAxis = clamp(dot(decodeOctahedral(r.x), to) * scale, -1.0, 1.0);
    float cosNormal = clamp(-dot(receiver.normal, to) * scale, -1.0, 1.0);
    vec2 cone = cosinesOfCone(r.y);
    float cosEmitted = cosOfExcess(cosOfExcess(cosAxis, cone.x), cosSphere);
    if (kHasPoints) cosEmitted = cosEmitted < cone.y ? 0.0 : cosEmitted;
    float cosReceived = max(cosOfExcess(cosNormal, cosSphere), 0.0);
    if (kHasGlass) cosReceived = receiver.normal == vec3(0.0) ? 1.0 : cosReceived;
    float cosines = max(cosEmitted, 0.0) * cosReceived;
    bool isWithin = squared <= squaredRadius;
    return LightBranch(uintBitsToFloat(r.z) * (isWithin ? 1.0 : cosines) / max(max(squared, squaredRadius), 1e-37), r.w);
}

struct LightPair {
    float chanceOfFirst;
    uint first;
    uint second;
    bool reaches; // some light of the pair does
};

LightPair lightPair(uint child, Receiver receiver) {
    LightBranch a = lightBranch(child, receiver);
    LightBranch b = lightBranch(child + 1u, receiver);
    float sum = a.importance + b.importance;
    return LightPair(a.importance / max(sum, 1e-37), a.child, b.child, sum > 1e-37);
}

uint rootChild() { return loadQuad(lights, frame.lightCount + 1u).w; }

LightChoice chooseLight(Receiver receiver, uint random) {
    uint child = rootChild();
    float chance = 1.0;
    float u = unitFloat(random);
    while ((child & kLightLeaf) == 0u) {
        LightPair pair = lightPair(child, receiver);
        random = pcg(random);
        float fresh = unitFloat(random);
        bool first = (kSampler == kSamplerRandom ? fresh : u) < pair.chanceOfFirst;
        if (kSampler != kSamplerRandom) u = leftOf(u, pair.chanceOfFirst, first, fresh);
        chance *= first ? pair.chanceOfFirst : 1.0 - pair.chanceOfFirst;
        child = first ? pair.first : pair.second;
        if (!pair.reaches) return LightChoice(0u, 0.0);
    }
    return LightChoice(child & ~kLightLeaf, chance);
}

// Of chooseLight to choose this light.
float chanceOfLight(uint light, Receiver receiver) {
    uint trail = loadQuad(lights, light).x;
    uint child = rootChild();
    float chance = 1.0;
    while ((child & kLightLeaf) == 0u) {
        LightPair pair = lightPair(child, receiver);
        bool first = (trail & 1u) == 0u;
        chance *= !pair.reaches ? 0.0 : (first ? pair.chanceOfFirst : 1.0 - pair.chanceOfFirst);
        child = first ? pair.first : pair.second;
        trail >>= 1u;
    }
    return chance;
}

#endif
