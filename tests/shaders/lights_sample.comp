#version 460
#extension GL_GOOGLE_include_directive : require
#pragma folders path/light_samplers/power_or_tree
// Light samples of one point, and the density that a ray in the same direction finds.
#include "lib/kernel.glsl"
#include "shared/path.h"
#include "harness.h"
#include "light_scene.glsl"

QUADS_WRITE(8, samples); // 3 each: direction, t max; radiance, density; density found by the ray, distance and primitive
                         // it hits, 1 = the light is punctual

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= harness.count) return;
    LightSample light = sampleLightFor(i, 0u);
    LightHit hit = castRay(harness.origin.xyz, light.direction);
    float pdf = 0.0;
    if (light.isPunctual) pdf = light.pdf; // no ray finds it
    else if (light.tMax == kFarAway) pdf = environmentPdf(equirectOfDirection(light.direction));
    else if (hit.t < kFarAway) pdf = hitPdf(hit, light.direction);
    storeQuad(samples, 3u * i, floatBitsToUint(vec4(light.direction, light.tMax)));
    storeQuad(samples, 3u * i + 1u, floatBitsToUint(vec4(light.radiance, light.pdf)));
    storeQuad(samples, 3u * i + 2u, uvec4(floatBitsToUint(pdf), floatBitsToUint(hit.t), hit.primitive, light.isPunctual ? 1u : 0u));
}
