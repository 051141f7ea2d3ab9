// Density of emissive triangles under light sampling. Bindings: scene.glsl's and `lights` (records); `params` is a
// BounceParams.
#ifndef IRRADIA_PATH_EMITTERS_GLSL
#define IRRADIA_PATH_EMITTERS_GLSL
#include "lib/sampling.glsl"
#include "path/scene.glsl"

float triangleChoice() { return kHasEnvironment && kHasEmitters ? 1.0 - params.environmentProbability : 1.0; }

// Density per solid angle of sampling a point of a light from distance t, at cosine |cosine| of its normal.
float trianglePdf(uint light, float area, float t, float cosine) {
    float mass = uintBitsToFloat(loadRecord(lights, light).w);
    return mass * t * t / max(area * cosine, 1e-30) * triangleChoice();
}

#endif
