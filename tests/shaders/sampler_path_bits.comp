#version 460
#extension GL_GOOGLE_include_directive : require
// The numbers of a path's decisions, for samples of many pixels.
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_WRITE(0, bits);
layout(push_constant) uniform Push { SamplerHarnessParams params; };
#define frame params
#include "path/sampler.glsl"

uvec4 bitsOf(uint pixel, uint sampleIndex) {
    if (params.which == kSamplerBsdf) return bsdfBits(pixel, sampleIndex, params.first.z, params.first.w);
    if (params.which == kSamplerLight) return lightBits(pixel, sampleIndex, params.first.z, params.first.w);
    return sampleBits(pixel, sampleIndex, params.first.z, params.first.w);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    storeQuad(bits, i, bitsOf(params.first.x + i / params.samples, params.first.y + i % params.samples));
}
