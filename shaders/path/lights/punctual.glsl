// Lights without extent (KHR_lights_punctual). No ray meets them: a sample of them has no density but the chance of its
// choice, and counts whole. Bindings: `lights` (quads); `frame` is FrameConstants.
#ifndef IRRADIA_PATH_LIGHTS_PUNCTUAL_GLSL
#define IRRADIA_PATH_LIGHTS_PUNCTUAL_GLSL
#include "lib/bsdf.glsl"
#include "shared/scene.h"

struct PunctualLight {
    vec4 place;     // position, 1 / range
    vec4 intensity; // rgb, 1 / (cos inner - cos outer)
    vec4 direction; // along which it shines, cos outer
};

PunctualLight loadPunctual(uint light) {
    uint at = frame.firstPunctual + light * kPunctualQuads;
    return PunctualLight(uintBitsToFloat(loadQuad(lights, at)), uintBitsToFloat(loadQuad(lights, at + 1u)),
                         uintBitsToFloat(loadQuad(lights, at + 2u)));
}

// Irradiance, from a point or a spot, of what faces it at a distance, in a unit direction from it.
vec3 punctualIrradiance(PunctualLight light, float distance, vec3 direction) {
    float within = clamp((dot(light.direction.xyz, direction) - light.direction.w) * light.intensity.w, 0.0, 1.0);
    float ended = square(square(distance * light.place.w));
    float falloff = square(within) * max(1.0 - ended, 0.0);
    return light.intensity.rgb * (falloff / max(square(distance), 1e-30));
}

// What they light: no mirror shows a light without extent, so of a surface that is one the diffuse lobe alone counts.
Bsdf bsdfUnderPunctual(Bsdf b) {
    bool isMirror = b.alpha <= kMinAlpha;
    b.specularF0 = isMirror ? vec3(0.0) : b.specularF0;
    b.specularF90 = isMirror ? 0.0 : b.specularF90;
    return b;
}

#endif
