// The numbers of a path's decisions, by blocks of four (lib/rng.glsl): independent ones, or points that are spread evenly over
// the samples of a pixel and over the pixels of a tile. shaders/README.md has what each of the four serves. `frame` has the
// picture's `width`.
#ifndef IRRADIA_PATH_SAMPLER_GLSL
#define IRRADIA_PATH_SAMPLER_GLSL
#include "lib/rng.glsl"
#include "lib/sobol.glsl"
#include "path/needs.glsl"

const uint kSobolBlocks = 0x80000000u; // their keys are no independent numbers of the same path

// A tile's pixels share one scrambled sequence. Each shifts it digit by digit (XOR) by a point of a second one, in z-order:
// neighbours then get points that are far apart, after Ahmed and Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo
// Sampling Error via Hierarchical Ordering of Pixels", and each keeps a scrambled sequence over all of its samples.
uvec4 sampleBits(uint pixel, uint sampleIndex, uint block, uint seed) {
    if (kSampler == kSamplerRandom) return randomBits(pixel, sampleIndex, block, seed);
    uint y = pixel / frame.width, x = pixel - y * frame.width;
    uvec2 inTile = uvec2(x, y) & kTileMask;
    uint firstOfTile = pixel - inTile.y * frame.width - inTile.x;
    uvec4 key = randomBits(firstOfTile, sampleIndex >> kSobolBits, block + kSobolBlocks, seed);
    return sobolBits(sampleIndex, key) ^ tileShift(inTile, pcg4d(key));
}

// Of a BSDF sample: lobe, direction (two), roulette. The first two dimensions, which are the best, go to the direction.
uvec4 bsdfBits(uint pixel, uint sampleIndex, uint depth, uint seed) {
    uvec4 bits = sampleBits(pixel, sampleIndex, bsdfBlock(depth), seed);
    return kSampler == kSamplerRandom ? bits : bits.zxyw;
}

// Of a light sample: light, its alias, point (two).
uvec4 lightBits(uint pixel, uint sampleIndex, uint depth, uint seed) {
    uvec4 bits = sampleBits(pixel, sampleIndex, lightBlock(depth), seed);
    return kSampler == kSamplerRandom ? bits : bits.zwxy;
}

// Whether the light is the environment is decided with what follows from it.
uint lightChoiceBits(uvec4 lightBits, uint pixel, uint sampleIndex, uint depth, uint seed) {
    if (kSampler == kSamplerRandom) return randomBits(pixel, sampleIndex, lightChoiceBlock(depth), seed).x;
    return lightBits.y;
}

// Of an entry of an alias table of `count` that uniformIndex(bits.x, count) chose: what the choice left of its number.
uint aliasBits(uvec4 bits, uint count) { return kSampler == kSamplerRandom ? bits.y : bits.x * count; }

// A number in [0, 1) makes a chain of choices: each takes what the last left of it, and what dividing made coarse is filled
// up by `fresh`, another.
const float kBelowOne = 0.999999940395355225;
float leftOf(float u, float chanceOfFirst, bool first, float fresh) {
    float part = first ? u : u - chanceOfFirst;
    return min((part + fresh * 5.9604644775390625e-8) / max(first ? chanceOfFirst : 1.0 - chanceOfFirst, 1e-37), kBelowOne);
}

#endif
