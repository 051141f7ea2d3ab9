// Parameters of the path tracer's passes, and what its specialisation constants may be.
#ifndef IRRADIA_SHARED_PATH_H
#define IRRADIA_SHARED_PATH_H
#include "shared/constants.h"
#include "shared/types.h"
SHARED_BEGIN

SHARED_CONST uint kSamplerRandom = 0u; // independent numbers
SHARED_CONST uint kSamplerSobol = 1u;  // of a pixel's samples, Owen-scrambled Sobol' points: spread evenly

// What the film shows: the picture, or what each path counts in the alpha of its radiance. Vertices of a path are those at which
// it scatters or asks the cache; the last ray of all only meets emission, and has none.
SHARED_CONST uint kViewPicture = 0u;
SHARED_CONST uint kViewEndVertex = 1u;       // number of the vertex that asks the cache (0 = the first), else of the last
SHARED_CONST uint kViewPathLength = 2u;      // vertices, as far as they are for the picture
SHARED_CONST uint kViewTrainingDensity = 3u; // vertices recorded for training

// A wave: 2^log2Samples consecutive samples of each of a run of pixels. Path i of the wave is sample
// sampleIndex + i % 2^log2Samples of pixel firstPixel + i / 2^log2Samples (path/wave.glsl).
struct WaveParams {
    uint firstPixel;
    uint sampleIndex; // of its first path
    uint log2Samples; // of a pixel
    uint paths;
    uint depth;       // number of the ray being handled; 0 = camera ray
    uint queueParity; // depth & 1: which counter of the RayQueue pair is current
};

// From this number on pixels stand for camera paths that are not seen and only train: number n of them looks through pixel
// n % (width * height). Their random numbers are their own.
SHARED_CONST uint kFirstTrainingPixel = 0x40000000u;
// Paths that no pixel sees: they start at points of the scene's surfaces. Their numbers take the place of pixels, beyond
// those of any picture, so that their random numbers are their own.
SHARED_CONST uint kFirstSurfacePath = 0x80000000u;

// What all waves of a frame share: a uniform buffer, CameraConstants behind FrameConstants (path/frame.glsl).
struct FrameConstants {
    uint seed;
    uint width; // of the picture
    uint height;
    uint triangles; // of the scene
    uint lightCount;       // local ones: emissive triangles, points, spots
    uint environmentWidth; // 1 x 1 for a constant
    uint environmentHeight;
    float environmentShare; // of light samples; 0 where it is black
    float directionalShare;
    float localShare;
    uint directionalCount; // of directional lights
    uint firstPunctual;    // quad of the lights
};

struct CameraConstants {
    vec4 position; // xyz; w: 1 = rays are parallel, 0 = they leave one point
    vec4 forward;  // unit
    vec4 right;    // times tan(vfov / 2) * aspect, or half the view's width if orthographic
    vec4 up;       // times tan(vfov / 2), or half the view's height
};

// Paths that start at surfaces.
struct SurfaceRayParams {
    WaveParams wave;
    float distance; // from which the points are seen
};

// begin_bounce writes the indirect arguments: three uints for tracing and three for per-item passes.
struct BeginBounceParams {
    uint parity;
    uint raysPerTraceGroup;
    uint itemsPerGroup;
    uint areTraced; // 0 = what the rays hit is known
};
SHARED_CONST uint kTraceArguments = 0u; // offsets in uints
SHARED_CONST uint kItemArguments = 4u;
SHARED_CONST uint kDispatchArguments = 8u; // size in uints

// The film, per pixel: Welford's running mean and sum of squared deviations over frames. A pass binds the
// film and the layers of its wave's pixels alone.
SHARED_CONST uint kFilmVectors = 2u;    // vec4: mean rgb, frames; M2 rgb, unused
SHARED_CONST uint kLayerVectors = 3u;   // vec4 sums: albedo rgb, hits; normal xyz, z; position xyz, unused

struct FilmParams {
    uint pixels;
    uint log2Samples;   // of a pixel in the wave
    uint part;          // mask of kFirstSamples and kLastSamples
    uint frame;         // frames in the film before this one
    float sampleWeight; // 1 / samples per frame
};
SHARED_CONST uint kFirstSamples = 1u; // the wave holds a frame's first samples of its pixels
SHARED_CONST uint kLastSamples = 2u;  // and its last: then the frame is added to the film

SHARED_END
#endif
