// Look-up in the reflectance table. Binding: `reflectanceTable` (quads).
#ifndef IRRADIA_PATH_REFLECTANCE_GLSL
#define IRRADIA_PATH_REFLECTANCE_GLSL
#include "path/needs.glsl"
#include "shared/scene.h"

vec3 loadReflectance(uint cosine, uint roughness) {
    return uintBitsToFloat(loadQuad(reflectanceTable, roughness * kTableCosines + cosine).xyz);
}

// (A, B, C) at cosine mu and perceptual roughness, bilinear between the table's nodes.
vec3 reflectanceAt(float mu, float roughness) {
    if (!kHasSpecular) return vec3(0.0);
    mu = clamp(mu, 0.0, 1.0);
    float a = kTableAlphaScale * max(roughness * roughness, kMinAlpha);
    float column = (2.0 * sqrt(mu) + sqrt(mu * (1.0 + a) / (mu + a))) / 3.0;
    float row = (sqrt(clamp(roughness, 0.0, 1.0)) - kTableFirstRoot) / (1.0 - kTableFirstRoot);
    float x = column * float(kTableCosines - 1u);
    float y = max(row, 0.0) * float(kTableRoughnesses - 1u);
    uint x0 = min(uint(x), kTableCosines - 2u);
    uint y0 = min(uint(y), kTableRoughnesses - 2u);
    float fx = x - float(x0);
    vec3 low = mix(loadReflectance(x0, y0), loadReflectance(x0 + 1u, y0), fx);
    vec3 high = mix(loadReflectance(x0, y0 + 1u), loadReflectance(x0 + 1u, y0 + 1u), fx);
    return mix(low, high, y - float(y0));
}

#endif
