// Emissive triangles as lights: their density under light sampling. Bindings: scene.glsl's and those of light_sampler.glsl,
// which chooses among them; `frame` is FrameConstants.
#ifndef IRRADIA_PATH_LIGHTS_TRIANGLES_GLSL
#define IRRADIA_PATH_LIGHTS_TRIANGLES_GLSL
#include "light_sampler.glsl"
#include "path/scene.glsl"

// Density per solid angle of sampling a point of a light chosen with some chance, from distance t, at cosine |cosine| of
// its normal.
float trianglePdf(float chance, float area, float t, float cosine) {
    return chance * t * t / max(area * cosine, 1e-37) * shareOfLocalLights();
}

#endif
