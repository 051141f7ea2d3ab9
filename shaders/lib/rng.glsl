// Counter-based random numbers: a value depends on (pixel, sample, dimension, seed) alone, never on a queue slot.
// pcg4d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
#ifndef IRRADIA_RNG_GLSL
#define IRRADIA_RNG_GLSL

uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// A next random number from one, for sequences whose length nobody knows (the same paper's "pcg").
uint pcg(uint v) {
    uint state = v * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Blocks of four dimensions: the camera takes block 0, the vertex at the end of ray d blocks 1 + 3 d to 3 + 3 d.
const uint kCameraBlock = 0u;
uint lightBlock(uint depth) { return 1u + 3u * depth; }
uint bsdfBlock(uint depth) { return 2u + 3u * depth; }
uint lightChoiceBlock(uint depth) { return 3u + 3u * depth; }

const uint kTileBlock = 0xffffffffu; // of (tile, sample) instead: the pixel of a tile that trains
const uint kSurfacePointBlock = 0xfffffffeu; // of a path that starts at a surface: where,
const uint kSurfaceViewBlock = 0xfffffffdu;  // and from where it is seen

uvec4 randomBits(uint pixel, uint sampleIndex, uint block, uint seed) {
    return pcg4d(uvec4(pixel, sampleIndex, block, seed));
}

// Uniform in [0, 1): 24 bits, so that 1 is never reached.
float unitFloat(uint bits) { return float(bits >> 8u) * 5.9604644775390625e-8; }
vec4 unitFloats(uvec4 bits) { return vec4(bits >> 8u) * 5.9604644775390625e-8; }

// Uniform integer in [0, count) from 32 bits (Lemire 2019, without the rejection: bias < count / 2^32).
uint uniformIndex(uint bits, uint count) {
    uint high, low;
    umulExtended(bits, count, high, low);
    return high;
}

#endif
