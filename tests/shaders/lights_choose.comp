#version 460
#extension GL_GOOGLE_include_directive : require
#pragma folders path/light_samplers/power_or_tree
// Choices of a local light by the hierarchy of lights at one point.
#include "lib/kernel.glsl"
#include "shared/path.h"
#include "harness.h"
#include "light_scene.glsl"

QUADS_WRITE(8, choices); // light, chance, chance that is found for the light

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= harness.count) return;
    LightChoice choice = chooseLight(harnessReceiver(), randomBits(i, 0u, lightBlock(0u), frame.seed).x);
    float found = chanceOfLight(choice.light, harnessReceiver());
    storeQuad(choices, i, uvec4(choice.light, floatBitsToUint(vec2(choice.chance, found)), 0u));
}
