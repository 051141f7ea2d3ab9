#version 460
#extension GL_GOOGLE_include_directive : require
// Adds a frame to the film: running mean and sum of squared deviations (Welford 1962). A frame's samples of a pixel are summed
// in their order, however many of them a wave holds.
#include "lib/kernel.glsl"
#include "path/needs.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Radiance { vec4 radiance[]; };
layout(set = 0, binding = 1, std430) buffer SampleSums { vec4 sampleSums[]; }; // from one wave to the next
layout(set = 0, binding = 2, std430) buffer Film { vec4 film[]; };
layout(push_constant) uniform Push { FilmParams params; };

vec3 shown(vec4 r) { return kView == kViewPicture ? r.rgb : vec3(r.a); }

void main() {
    uint pixel = gl_GlobalInvocationID.x;
    if (pixel >= params.pixels) return;
    vec3 sum = (params.part & kFirstSamples) != 0u ? vec3(0.0) : sampleSums[pixel].rgb;
    uint path = pixel << params.log2Samples, end = path + (1u << params.log2Samples);
    do sum += shown(radiance[path]);
    while (++path < end);
    if ((params.part & kLastSamples) == 0u) {
        sampleSums[pixel] = vec4(sum, 0.0);
        return;
    }

    uint at = pixel * kFilmVectors;
    vec3 value = sum * params.sampleWeight;
    vec3 mean = params.frame == 0u ? vec3(0.0) : film[at].rgb;
    vec3 m2 = params.frame == 0u ? vec3(0.0) : film[at + 1u].rgb;
    vec3 delta = value - mean;
    mean += delta / float(params.frame + 1u);
    film[at] = vec4(mean, float(params.frame + 1u));
    film[at + 1u] = vec4(m2 + delta * (value - mean), 0.0);
}
