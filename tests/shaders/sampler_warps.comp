#version 460
#extension GL_GOOGLE_include_directive : require
// The warps of the unit square, each over the path tracer's own random numbers.
#include "lib/kernel.glsl"
#include "lib/rng.glsl"
#include "lib/sampling.glsl"
#include "harness.h"

QUADS_WRITE(0, samples);
layout(push_constant) uniform Push { WarpHarnessParams params; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    vec4 u = unitFloats(randomBits(i, 0u, 0u, params.seed));
    vec4 result = vec4(0.0);
    switch (params.warp) {
    case kWarpCosineHemisphere: result.xyz = sampleCosineHemisphere(u.xy); break;
    case kWarpTriangle: result.xy = sampleTriangle(u.xy); break;
    case kWarpVisibleNormal: result.xyz = sampleVisibleNormal(params.view.xyz, params.view.w, u.xy); break;
    case kWarpEquirect: result = vec4(u.xy, equirectOfDirection(directionOfEquirect(u.xy))); break;
    }
    storeQuad(samples, i, floatBitsToUint(result));
}
