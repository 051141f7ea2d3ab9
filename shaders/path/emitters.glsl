// Density of emissive triangles under light sampling. Bindings: scene.glsl's and `lights` (records); `params` is a
// BounceParams.
#ifndef IRRADIA_PATH_EMITTERS_GLSL
#define IRRADIA_PATH_EMITTERS_GLSL
#include "lib/sampling.glsl"
#include "path/light_tree.glsl"
#include "path/scene.glsl"

float triangleChoice() { return kHasEnvironment && kHasEmitters ? 1.0 - params.environmentProbability : 1.0; }

// Of light sampling to choose this light.
float lightChance(uint light, Receiver receiver) {
    if (kHasLightTree) return chanceOfLight(light, receiver);
    return uintBitsToFloat(loadRecord(lights, light).w);
}

// Density per solid angle of sampling a point of a light chosen with some chance, from distance t, at cosine |cosine| of
// its normal.
float trianglePdf(float chance, float area, float t, float cosine) {
    return chance * t * t / max(area * cosine, 1e-37) * triangleChoice();
}

#endif
