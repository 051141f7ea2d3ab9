#version 460
#extension GL_GOOGLE_include_directive : require
// Item i: random glass with numbers at the ends of their ranges, a random view and direction, and a sampled one. Results:
// how many numbers are no numbers, infinite or below zero; the largest f cos / pdf of a sample, in all channels.
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, reflectanceTable);
QUADS_READ(1, glassTable);
QUADS_WRITE(2, results);
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "lib/glass.glsl"
#include "lib/rng.glsl"
#include "path/glass_table.glsl"
#include "path/reflectance.glsl"

bool isWrong(float x) { return (floatBitsToUint(x) & 0x7f800000u) == 0x7f800000u || x < 0.0; }
uint wrong(vec4 v) { return uint(isWrong(v.x)) + uint(isWrong(v.y)) + uint(isWrong(v.z)) + uint(isWrong(v.w)); }

// A quarter of the numbers at each end.
vec4 gathered(vec4 u) { return clamp(2.0 * u - 0.5, 0.0, 1.0); }

// Half of the cosines within 1e-4 of 0 or 1, down to 1e-7.
vec3 directionOf(vec4 u) {
    float small = exp2(-23.25 + 10.0 * fract(u.x * 4.0));
    float z = u.x < 0.25 ? small : (u.x < 0.5 ? 1.0 - small : max(u.y, 1e-7));
    float r = sqrt(max(1.0 - z * z, 0.0));
    return vec3(r * cos(6.2831853 * u.z), r * sin(6.2831853 * u.z), u.w < 0.5 ? z : -z);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    vec4 u[6];
    for (uint k = 0u; k < 6u; ++k) u[k] = unitFloats(randomBits(i, 0u, k, params.seed));
    vec4 c0 = gathered(u[0]), c1 = gathered(u[1]), c2 = gathered(u[2]);
    float low = 1.0 / 2.6;
    float eta = c2.x < 0.5 ? mix(low, 1.0, 2.0 * c2.x) : 1.0 / mix(1.0, low, 2.0 * c2.x - 1.0);
    if (u[2].y < 0.1) eta = 1.0;
    if (u[2].y > 0.9) eta = 1.0 + (u[2].x - 0.5) * 1e-5;
    float roughness = u[2].z < 0.2 ? 0.0316228 + 1e-6 * u[2].w : c2.z;
    vec3 v = directionOf(vec4(u[3].xyz, 0.0));
    vec3 l = directionOf(u[4]);

    Bsdf b = makeBsdf(c0.rgb, c0.w, roughness, c1.rgb, c1.w);
    b.diffuse *= 1.0 - c2.w;
    Glass g = makeGlass(c0.rgb, c0.w, c2.w, c1.rgb, c1.w, awayFromOne(eta), u[5].w < 0.3);
    vec3 abc = reflectanceAt(thinCosine(g, v.z), roughness);
    float mendV = glassMend(b, g, v.z, abc);
    GlassView view = prepareGlass(b, g, v, abc, mendV, glassLossesOf(g, b.alpha, v, abc));

    uint count = wrong(vec4(view.pDiffuse, view.pFacets, view.pMultiple, view.pReturn)) + uint(isWrong(view.multiple));
    float largest = 0.0;
    for (uint k = 0u; k < 2u; ++k) {
        if (k == 1u) l = sampleGlass(b, g, view, v, u[5].xyz);
        count += wrong(vec4(abs(l), 0.0));
        vec3 abcL = reflectanceAt(thinCosine(g, abs(l.z)), roughness);
        float mend = min(mendV, glassMend(b, g, abs(l.z), abcL));
        float loss = glassLossTowards(g, b.alpha, l, abcL);
        BsdfValue value = evaluateGlass(b, g, view, v, l, mend, loss, false);
        vec3 punctual = evaluateGlass(b, g, view, v, l, mend, loss, true).fCos;
        count += wrong(vec4(value.fCos, value.pdf)) + wrong(vec4(punctual, loss));
        if (k == 1u && value.pdf > 0.0) largest = maxComponent(value.fCos) / value.pdf;
    }
    storeQuad(results, i, uvec4(count, floatBitsToUint(largest), floatBitsToUint(v.z), floatBitsToUint(eta)));
}
