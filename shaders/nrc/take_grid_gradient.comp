#version 460
#extension GL_GOOGLE_include_directive : require
// Gradients from the sums of accumulate_grid_gradient, times a factor; the sums become zero.
#include "lib/kernel.glsl"
#include "shared/network.h"

RECORDS(0, sums);
COUNTERS_READ(1, scale);
RECORDS_WRITE(2, gradients);
layout(push_constant) uniform Push { TakeGradientParams params; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.featureQuads) return;
    ivec4 low = ivec4(loadRecord(sums, i));
    ivec4 high = ivec4(loadRecord(sums, params.featureQuads + i));
    float unit = uintBitsToFloat(scale[params.scaleWord]) / kGradientUnits;
    vec4 gradient = (vec4(high) * 4294967296.0 + vec4(low)) * unit;
    storeRecord(gradients, i, floatBitsToUint(gradient));
    if (low == ivec4(0) && high == ivec4(0)) return; // most features, where the grid is fine
    storeRecord(sums, i, uvec4(0u));
    storeRecord(sums, params.featureQuads + i, uvec4(0u));
}
