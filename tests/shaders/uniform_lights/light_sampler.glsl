// Which light is sampled: any of the emissive triangles with one probability, the environment half of the time.
#ifndef IRRADIA_LIGHT_SAMPLER_GLSL
#define IRRADIA_LIGHT_SAMPLER_GLSL
#include "lib/rng.glsl"
#include "path/light_choice.glsl"
#include "path/needs.glsl"

float shareOfEnvironment() { return kHasEnvironment && kHasEmitters ? 0.5 : 1.0; }
float shareOfTriangles() { return shareOfEnvironment(); }

float lightChance(uint light, Receiver receiver) { return 1.0 / float(frame.lightCount); }

LightChoice chooseTriangleLight(Receiver receiver, uvec4 random) {
    return LightChoice(uniformIndex(random.x, frame.lightCount), lightChance(0u, receiver));
}

#endif
