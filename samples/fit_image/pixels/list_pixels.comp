#version 460
#extension GL_GOOGLE_include_directive : require
// Rows of inputs for consecutive pixels; rows beyond the picture repeat its last one.
#include "lib/kernel.glsl"
#include "pixels.glsl"

QUADS_WRITE(0, inputs);
layout(push_constant) uniform Push { ListParams params; };

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= params.rows) return;
    uint pixel = min(params.first + row, params.width * params.height - 1u);
    storeQuad(inputs, row, floatBitsToUint(vec4(pixelPlace(pixel, params.width, params.height), 0.0, 0.0)));
}
