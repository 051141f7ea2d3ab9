#version 460
#extension GL_GOOGLE_include_directive : require
#pragma folders path/taps/none path/light_samplers/power_or_tree
#pragma variant scatter_cached path/taps/radiance_cache
// The vertex at a hit: one light sample (a shadow ray) and one BSDF sample (the path's next ray).
#include "lib/kernel.glsl"
#include "path/frame.glsl"
#include "shared/queue.h"

FRAME_CONSTANTS(0);
QUADS_READ(1, rays);
QUADS_READ(2, hits);
COUNTERS(3, counters);
QUADS_READ(4, geometry);
QUADS_READ(5, attributes);
QUADS_READ(6, materials);
QUADS_READ(7, textures);
HALVES_READ(8, texels);
QUADS_READ(9, lights);
QUADS_READ(10, environment);
QUADS_READ(11, environmentAlias);
QUADS_READ(12, reflectanceTable);
QUADS_WRITE(13, nextRays);
QUADS_WRITE(14, shadowRays);
QUADS(15, passages);
QUADS_READ(16, glassTable);
layout(push_constant) uniform Push { WaveParams params; };
#include "path/light_sampling.glsl"
#include "path/passage.glsl"
#include "path/sampler.glsl"
#include "path/scattering.glsl"
#include "path/wave.glsl"
#define TAP_BINDING 17
#include "tap_light.glsl"
#include "tap_vertex.glsl"

// The item's slot in a queue; one atomic per subgroup. Slots decide nothing but the order of work.
uint pushItem(uint counter, bool alive) {
    uvec4 ballot = subgroupBallot(alive);
    uint base = 0u;
    if (subgroupElect()) base = atomicAdd(counters[counter], subgroupBallotBitCount(ballot));
    return subgroupBroadcastFirst(base) + subgroupBallotExclusiveBitCount(ballot);
}

void pushShadowRay(bool alive, vec3 origin, float tMax, vec3 direction, uint path, vec3 contribution) {
    uint slot = pushItem(kShadowRayCounter, alive) * kShadowRayQuads;
    if (!alive) return;
    storeQuad(shadowRays, slot, uvec4(floatBitsToUint(origin), floatBitsToUint(tMax)));
    storeQuad(shadowRays, slot + 1u, uvec4(floatBitsToUint(direction), path));
    storeQuad(shadowRays, slot + 2u, uvec4(floatBitsToUint(contribution), 0u));
}

void pushRay(bool alive, vec3 origin, vec3 direction, uint path, vec3 beta, float pdf, uint normal) {
    uint slot = pushItem(kRayCounter + 1u - params.queueParity, alive) * kRayQuads;
    if (!alive) return;
    storeQuad(nextRays, slot, uvec4(floatBitsToUint(origin), path));
    storeQuad(nextRays, slot + 1u, uvec4(floatBitsToUint(direction), floatBitsToUint(pdf)));
    storeQuad(nextRays, slot + 2u, uvec4(floatBitsToUint(beta), normal));
}

void main() {
    uint item = gl_GlobalInvocationID.x;
    uint count = counters[kRayCounter + params.queueParity];
    uint slot = min(item, count - 1u); // every lane of a subgroup stays for the pushes
    uvec4 hit = loadQuad(hits, slot);
    bool alive = item < count && hit.y != kNoPrimitive;
    uint path = loadQuad(rays, slot * kRayQuads).w;
    vec3 view = -uintBitsToFloat(loadQuad(rays, slot * kRayQuads + 1u).xyz);
    vec3 beta = uintBitsToFloat(loadQuad(rays, slot * kRayQuads + 2u).rgb);
    uint pixel = pixelOf(path);
    uint sampleIndex = sampleOf(path);

    uint media = kHasTransparency ? loadQuad(passages, path).w : kNoMedia;
    Surface s = loadSurface(alive ? hit.y : 0u, uintBitsToFloat(hit.zw), view, media);
    float arrivalPdf = uintBitsToFloat(loadQuad(rays, slot * kRayQuads + 1u).w);
    vec3 passage = passageOf(path);
    beta *= passage;
    Visit visit = arrive(alive, path, pixel, s, view, uintBitsToFloat(hit.x), arrivalPdf, passage, beta);
    alive = visit.goesOn;
    vec3 directLight = vec3(0.0); // as the tap hears it
    Frame local = frameFromNormal(s.shadingNormal);
    Scattering scattering = prepareScattering(s, toLocal(local, view));

    uint normalCode = receiverCode(s); // as a ray's emissive hit will find it
    if (kLightGroups > 0) {
        uvec4 random = lightBits(pixel, sampleIndex, params.depth, frame.seed);
        float choice = kLightGroups > 1
                           ? unitFloat(lightChoiceBits(random, pixel, sampleIndex, params.depth, frame.seed))
                           : 0.0;
        LightSample light = sampleLight(receiverOf(leavingPoint(s, vec3(0.0)), normalCode), random, choice);
        vec3 l = toLocal(local, light.direction);
        BsdfValue value = evaluateScattering(s, scattering, l, light.isPunctual);
        if (kHasGlass && light.tMax < kFarAway)
            light.radiance *= transmittanceOf(innermost(leavingMedia(s, l)), light.tMax);
        bool arrives = isScattered(s, l, light.direction) && light.pdf > 0.0;
        vec3 contribution =
            arrives ? beta * value.fCos * light.radiance * lightWeight(light, value.pdf) : vec3(0.0);
        bool counts = maxComponent(contribution) > 0.0;
        if (visit.listens && arrives)
            directLight = value.fCos * light.radiance * lightWeight(light, value.pdf);
        counts = counts || maxComponent(directLight) > 0.0;
        pushShadowRay(alive && counts, leavingPoint(s, l), light.tMax, light.direction, path, contribution);
    }

    vec4 u = unitFloats(bsdfBits(pixel, sampleIndex, params.depth, frame.seed));
    vec3 l = sampleScattering(s, scattering, u.xyz);
    vec3 direction = toWorld(local, l);
    BsdfValue value = evaluateScattering(s, scattering, l, false);
    bool isFollowed = isScattered(s, l, direction) && value.pdf > 0.0;
    vec3 nextBeta = isFollowed ? beta * value.fCos / value.pdf : vec3(0.0);
    // Russian roulette after bounce 3, on the throughput itself.
    float survival = params.depth >= 3u ? min(maxComponent(nextBeta), 1.0) : 1.0;
    vec3 throughput = isFollowed ? value.fCos / value.pdf : vec3(0.0);
    survival = survivalOf(visit, survival, throughput);
    bool scatters = maxComponent(nextBeta) > 0.0 || goesOnUnseen(visit, throughput);
    leave(visit, directLight, throughput / max(survival, 1e-30));
    bool survives = scatters && u.w < survival;
    uint nextMedia = kHasGlass ? leavingMedia(s, l) : kNoMedia;
    if (kHasTransparency && alive) storeQuad(passages, path, uvec4(floatBitsToUint(vec3(1.0)), nextMedia));
    pushRay(alive && survives, leavingPoint(s, l), direction, path, nextBeta / max(survival, 1e-30), value.pdf, normalCode);
}
