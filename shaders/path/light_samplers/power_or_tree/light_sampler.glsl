// Which light is sampled: each group with a probability of its own (of the environment's and directional lights each has one
// chance everywhere), local lights by power through an alias table (Vose 1991) where they are few, by what reaches the point
// where they are many (light_tree.glsl). What any light sampler provides. Bindings: `lights` (quads); `frame` is
// FrameConstants.
#ifndef IRRADIA_LIGHT_SAMPLER_GLSL
#define IRRADIA_LIGHT_SAMPLER_GLSL
#include "path/light_samplers/power_or_tree/light_tree.glsl"
#include "path/needs.glsl"

// Of light samples.
float shareOfEnvironment() { return kLightGroups > 1 ? frame.environmentShare : 1.0; }
float shareOfDirectionalLights() { return kLightGroups > 1 ? frame.directionalShare : 1.0; }
float shareOfLocalLights() { return kLightGroups > 1 ? frame.localShare : 1.0; }

// Of light sampling to choose this light among the local ones.
float lightChance(uint light, Receiver receiver) {
    if (kHasLightTree) return chanceOfLight(light, receiver);
    return uintBitsToFloat(loadQuad(lights, light).w);
}

LightChoice chooseLocalLight(Receiver receiver, uvec4 random) {
    if (kHasLightTree) return chooseLight(receiver, random.x);
    uint light = uniformIndex(random.x, frame.lightCount);
    uvec4 entry = loadQuad(lights, light);
    light = unitFloat(aliasBits(random, frame.lightCount)) < uintBitsToFloat(entry.x) ? light : entry.y;
    return LightChoice(light, lightChance(light, receiver));
}

#endif
