// Warps of the unit square and their densities; weights of multiple importance sampling.
#ifndef IRRADIA_SAMPLING_GLSL
#define IRRADIA_SAMPLING_GLSL
#include "lib/math.glsl"

// Cosine-weighted hemisphere around +z (Malley); density z / pi.
vec3 sampleCosineHemisphere(vec2 u) {
    float r = sqrt(u.x);
    float phi = 2.0 * kPi * u.y;
    return vec3(r * cos(phi), r * sin(phi), sqrt(max(1.0 - u.x, 0.0)));
}

// Barycentrics (of e1, e2) uniform over a triangle's area (Turk 1990).
vec2 sampleTriangle(vec2 u) {
    float s = sqrt(u.x);
    return vec2(s * (1.0 - u.y), s * u.y);
}

// Visible normal of GGX, isotropic, view v in the local frame with v.z > 0 (Dupuy and Benyoub 2023, "Sampling
// Visible GGX Normals with Spherical Caps"). Density over normals: G1(v) D(h) max(v.h, 0) / v.z.
vec3 sampleVisibleNormal(vec3 v, float alpha, vec2 u) {
    vec3 s = normalize(vec3(v.xy * alpha, v.z));
    float phi = 2.0 * kPi * u.x;
    float z = (1.0 - u.y) * (1.0 + s.z) - s.z;
    float r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + s;
    return normalize(vec3(h.xy * alpha, max(h.z, 1e-7)));
}

// Power heuristic, exponent 2 (Veach and Guibas 1995), of a sample drawn with density p against density q. Written in
// the ratio of both, whose square neither overflows nor vanishes: the weights of two techniques sum to 1 at any scale.
float powerHeuristic(float p, float q) {
    float ratio = min(p, q) / max(max(p, q), 1e-37);
    float squared = ratio * ratio;
    return (p >= q ? 1.0 : squared) / (1.0 + squared);
}

// The direction of equirectangular (u, v), and back: u = atan2(z, x) / 2 pi + 1/2, v = acos(y) / pi.
vec3 directionOfEquirect(vec2 uv) {
    float phi = (uv.x - 0.5) * 2.0 * kPi;
    float theta = uv.y * kPi;
    float s = sin(theta);
    return vec3(s * cos(phi), cos(theta), s * sin(phi));
}

vec2 equirectOfDirection(vec3 d) {
    // atan(0, 0) is not defined: the poles take u = 1/2.
    float phi = abs(d.x) + abs(d.z) > 0.0 ? atan(d.z, d.x) : 0.0;
    // Not acos: that is good to 1e-5 on some devices, and to sqrt(ulp) at the poles on all.
    return vec2(phi * (0.5 * kInvPi) + 0.5, atan(length(d.xz), d.y) * kInvPi);
}

#endif
