#version 460
#extension GL_GOOGLE_include_directive : require
// A batch of training records: places of random pixels and their colours. The pixels in their order are cut into as many
// strata as there are rows, and each row draws from its own: every pixel is equally likely, none of the picture's parts is
// left out of a batch, and neighbouring rows read neighbouring features. Places are pixel centres, so that a record's colour
// is the picture's own and no filter decides what lies between.
#include "lib/kernel.glsl"
#include "lib/rng.glsl"
#include "pixels.glsl"

QUADS_READ(0, picture);
QUADS_WRITE(1, inputs);
QUADS_WRITE(2, targets);
layout(push_constant) uniform Push { DrawParams params; };

uint drawPixel(uint row) {
    uint bits = randomBits(row, params.step, 0u, params.seed).x;
    // A number in [row, row + 1) of 2^log2Rows, as a fraction of 2^32.
    uint fraction = params.log2Rows == 0u ? bits : (row << (32u - params.log2Rows)) | (bits >> params.log2Rows);
    return uniformIndex(fraction, params.width * params.height);
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >> params.log2Rows != 0u) return;
    uint pixel = drawPixel(row);
    uvec4 pair = loadQuad(picture, pixel / kPixelsPerRecord);
    uvec2 halves = (pixel & 1u) == 0u ? pair.xy : pair.zw;
    vec4 colour = vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y));
    storeQuad(inputs, row, floatBitsToUint(vec4(pixelPlace(pixel, params.width, params.height), 0.0, 0.0)));
    storeQuad(targets, row, floatBitsToUint(colour));
}
