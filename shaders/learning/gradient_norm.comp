#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant gradient_norm_from_sums FROM_SUMS
// Partial sums of the gradient's squared norm, each over a fixed share of the parameters. What optimize leaves out is
// left out here.
#include "lib/kernel.glsl"
#include "learning/state.glsl"

STATE_READ(0);
QUADS_READ(1, gradients);
WORDS_WRITE(2, partials);
layout(push_constant) uniform Push { NormParams params; };

#include "learning/gradient.glsl"

vec4 gradientAt(uint quad) {
    uvec4 first = loadQuad(gradients, quad);
#ifdef FROM_SUMS
    return gradientFromSums(ivec4(first), ivec4(loadQuad(gradients, params.quads + quad)));
#else
    return uintBitsToFloat(first);
#endif
}

shared float sums[gl_WorkGroupSize.x];

void main() {
    float sum = 0.0;
    for (uint quad = gl_GlobalInvocationID.x; quad < params.quads; quad += kNormPartials * gl_WorkGroupSize.x) {
        vec4 g = gradientAt(quad);
        g = mix(vec4(0.0), g, lessThanEqual(abs(g), vec4(kGradientLimit)));
        sum += dot(g, g);
    }
    sums[gl_LocalInvocationID.x] = sum;
    barrier();
    if (gl_LocalInvocationID.x != 0u) return;
    float total = 0.0;
    for (uint i = 0u; i < gl_WorkGroupSize.x; ++i) total += sums[i];
    storeWord(partials, params.firstPartial + gl_WorkGroupID.x, floatBitsToUint(total));
}
