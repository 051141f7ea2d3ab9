// Push constants of the harness kernels, which run functions of the shaders over arrays.
#ifndef IRRADIA_TESTS_HARNESS_H
#define IRRADIA_TESTS_HARNESS_H
#include "shared/types.h"
SHARED_BEGIN

struct BsdfHarnessParams {
    uint count; // of invocations
    uint caseIndex;
    uint seed;
    uint strata; // a case draws strata x strata samples
};

SHARED_CONST uint kWarpCosineHemisphere = 0u;
SHARED_CONST uint kWarpTriangle = 1u;
SHARED_CONST uint kWarpVisibleNormal = 2u;
SHARED_CONST uint kWarpEquirect = 3u;

struct WarpHarnessParams {
    vec4 view; // xyz: view direction of kWarpVisibleNormal; w: its alpha
    uint warp;
    uint count;
    uint seed;
    uint pad;
};

// Key of value i: first + i * step, component by component.
struct RngHarnessParams {
    uvec4 first; // pixel, sample, block, seed
    uvec4 step;
    uint count;
};

struct CountParams {
    uint count;
};

// Numbers of samples of consecutive pixels: value i is of pixel first.x + i / samples, sample first.y + i %
// samples.
struct SamplerHarnessParams {
    uvec4 first; // pixel, sample, block (or depth), seed
    uint samples;
    uint count;
    uint which; // kSamplerBlock, ...
    uint width; // of the picture
};
SHARED_CONST uint kSamplerBlock = 0u; // of block first.z
SHARED_CONST uint kSamplerBsdf = 1u;  // of the BSDF sample at depth first.z
SHARED_CONST uint kSamplerLight = 2u;

struct PermuteParams {
    uint count;
    uint key;
};

// Follows the FrameConstants that the functions of shaders/path expect.
struct LightHarnessParams {
    vec4 origin;  // xyz: the shaded point; w unused
    vec4 normal;  // xyz: its normal; w: roughness of its BSDF
    vec4 view;    // xyz: direction to the viewer; w: metallic
    uint count;   // of invocations
    uint samples; // of each
    uint triangleCount;
    uint pad;
};

// The pixels of `frames` frames, one after the other.
struct CacheTilesParams {
    uint width;
    uint height;
    uint tilesX;
    uint tilesY;
    uint frames;
    uint seed;
};

struct PlaneErrorParams {
    uint count;
};

// Follows the CacheRule.
struct CacheWalkParams {
    uint paths;
    uint depths; // vertices of each
    uint sampleIndex;
    uint seed;
    uint width; // of a picture of one row
};
// Of each vertex: position, distance; view, pdf; geometric normal, roughness; shading normal, the BSDF's
// alpha; diffuse, 1 as uint bits where the path goes on; specular; throughput; light that arrives; emission
// that the next ray meets.
SHARED_CONST uint kWalkVertexQuads = 9u;

SHARED_END
#endif
