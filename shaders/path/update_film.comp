#version 460
#extension GL_GOOGLE_include_directive : require
// Adds a frame to the film: running mean and sum of squared deviations (Welford 1962).
#include "lib/kernel.glsl"
#include "path/needs.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Radiance { vec4 radiance[]; };
layout(set = 0, binding = 1, std430) buffer Film { vec4 film[]; };
layout(push_constant) uniform Push { FilmParams params; };

void main() {
    uint path = gl_GlobalInvocationID.x;
    if (path >= params.pathCount) return;
    uint at = (params.firstPixel + path) * kFilmVectors;
    vec3 shown = kView == kViewPicture ? radiance[path].rgb : vec3(radiance[path].a);
    vec3 value = shown * params.sampleWeight;
    vec3 mean = params.frame == 0u ? vec3(0.0) : film[at].rgb;
    vec3 m2 = params.frame == 0u ? vec3(0.0) : film[at + 1u].rgb;
    vec3 delta = value - mean;
    mean += delta / float(params.frame + 1u);
    film[at] = vec4(mean, float(params.frame + 1u));
    film[at + 1u] = vec4(m2 + delta * (value - mean), 0.0);
}
