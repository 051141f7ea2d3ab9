// Which light is sampled: each group that there is with one probability, and so any of the local lights.
#ifndef IRRADIA_LIGHT_SAMPLER_GLSL
#define IRRADIA_LIGHT_SAMPLER_GLSL
#include "lib/rng.glsl"
#include "path/light_choice.glsl"
#include "path/needs.glsl"

float shareOfEnvironment() { return 1.0 / float(kLightGroups); }
float shareOfDirectionalLights() { return shareOfEnvironment(); }
float shareOfLocalLights() { return shareOfEnvironment(); }

float lightChance(uint light, Receiver receiver) { return 1.0 / float(frame.lightCount); }

LightChoice chooseLocalLight(Receiver receiver, uvec4 random) {
    return LightChoice(uniformIndex(random.x, frame.lightCount), lightChance(0u, receiver));
}

#endif
