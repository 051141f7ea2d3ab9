#version 460
#extension GL_GOOGLE_include_directive : require
// The gradient by each weight: partial sums of the row chunks in their order, times the float `scale`.
#include "lib/kernel.glsl"
#include "shared/network.h"

QUADS_READ(0, partials);
WORDS_READ(1, scale);
QUADS_WRITE(2, gradients);
layout(push_constant) uniform Push { SumGradientsParams params; };

void main() {
    uint quad = gl_GlobalInvocationID.x;
    if (quad >= params.weightQuads) return;
    vec4 sum = vec4(0.0);
    for (uint chunk = 0u; chunk < params.chunks; ++chunk)
        sum += uintBitsToFloat(loadQuad(partials, chunk * params.weightQuads + quad));
    storeQuad(gradients, quad, floatBitsToUint(sum * uintBitsToFloat(loadWord(scale, params.scaleWord))));
}
