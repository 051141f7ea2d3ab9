// Where the path tracer and the radiance cache meet (Müller 2021): what paths ask the cache, and what they tell it.
//
// The contract. The cache holds scattered radiance L_s(x, omega): all light that x scatters towards omega, its direct light
// included, its own emission not. A path x1 ... xn that ends in the cache takes light samples at x1 ... x_(n-1) only; at xn
// it adds xn's emission, weighted against light sampling as everywhere, and the prediction.
//
// Targets go backwards along a training path:
//   L_s(i) = gathered(i) + throughput(i) L_s(i + 1),  throughput = f cos / (pdf * survival)
// where gathered is light sampled at i, and emission met by its ray times the throughput. The last L_s is the prediction at
// the vertex where the training path ends in the cache, or 0 if it ended by itself.
#ifndef IRRADIA_SHARED_CACHE_H
#define IRRADIA_SHARED_CACHE_H
#include "shared/path.h"
#include "shared/types.h"
SHARED_BEGIN

// What the cache knows of a vertex, the inputs of its network, in this order:
//   position 3    (p - boxLow) * boxScale: the scene box's longest edge has length 1
//   direction 2   towards which light is scattered: (theta, phi) of sphericalCoordinates
//   normal 2      shading normal, likewise
//   roughness 1   1 - exp(-roughness)
//   alpha 3       diffuse reflectance: base colour (1 - metallic)
//   beta 3        specular reflectance: mix(F0, base colour, metallic)
// stored as kCacheInputQuads quads, the last two values zero. alpha + beta is the reflectance by which predictions are
// multiplied where the cache factorises it.
SHARED_CONST uint kCacheInputs = 14u;
SHARED_CONST uint kCacheInputQuads = 4u;
SHARED_CONST uint kCacheInputBytes = kCacheInputQuads * 16u; // of a row
SHARED_CONST uint kCacheOutputs = 3u;

// Words of the cache's counters.
SHARED_CONST uint kQueryCounter = 0u;  // queries of the wave
SHARED_CONST uint kRecordCounter = 1u; // training records of the frame
SHARED_CONST uint kTrainingPathCounter = 2u; // training queries: one row a training path, always all of them
SHARED_CONST uint kSkippedRecords = 3u;      // of the frame: beyond the records' capacity
SHARED_CONST uint kClampedPredictions = 4u;  // since the start: not finite
SHARED_CONST uint kCacheCounters = 8u;

// Query, one row of inputs (shared/network.h's order of quads), and beside it one quad: weight rgb of the prediction,
// path index to whose radiance it is added.

// Where paths end. A vertex outside the box never asks the cache.
struct CacheRule {
    vec4 boxLow;  // xyz; w = boxScale
    vec4 boxHigh; // xyz; w = c of the area spread a(x1 ... xn) > c a0; infinite = never, negative = at the first vertex
    uint endDepth; // number of the vertex at which paths end whatever their spread (0 = the first); kNoDepth = by spread alone
    uint lastDepth;   // at which training paths end in the cache, whatever their spread
    uint tilesX;      // one training path a tile and frame; 0 = none. Those of waves that are not seen have the numbers after these
    uint tilesY;
    float unbiasedShare; // of training paths that end by themselves
    float residualShare; // of paths that go on past their query, so that the whole is unbiased; 0 = none
    float trainingSpread; // c of the suffixes
    uint deepest;         // number of the last ray of rendering paths, which only meets emission
    uint firstTraining;   // training path from which on paths and vertices are bound, a multiple of kTileRows
    uint waveTraining;    // that of the first path of a wave that is not seen
    uint pad0;            // to a multiple of 16 bytes
    uint pad1;
};
SHARED_CONST uint kNoDepth = 0xffffffffu;

// PathState, one quad a path of the wave: a0 (float), square root of the area spread so far (float), training path of those
// bound + 1 (0 = none), flags.
SHARED_CONST uint kPathEnded = 1u;    // for rendering: what follows only trains
SHARED_CONST uint kPathAsked = 2u;    // has had its query, and goes on for the residual
SHARED_CONST uint kPathUnbiased = 4u; // its suffix is not ended by the spread
SHARED_CONST uint kPathMirrored = 8u; // its ray comes from a delta lobe

// TrainingPath: vec4 (weight rgb from the last recorded vertex to the ray in flight, number of vertices as uint bits),
// vec4 (light sample in flight rgb, 1 as uint bits where the path has ended in the cache: then its row of training queries
// holds where).
SHARED_CONST uint kTrainingPathVectors = 2u;
SHARED_CONST uint kMaxTrainingVertices = 8u; // recorded; light met later is added to the last of them

// TrainingVertex, vertex v of path t at t kMaxTrainingVertices + v: kCacheInputQuads vec4 of inputs, vec4 (gathered rgb, 0),
// vec4 (throughput rgb to the next recorded vertex or the end in the cache, 0).
SHARED_CONST uint kTrainingVertexVectors = kCacheInputQuads + 2u;
SHARED_CONST uint kTrainingPathBytes = kTrainingPathVectors * 16u; // of a path
SHARED_CONST uint kVertexBytes = kMaxTrainingVertices * kTrainingVertexVectors * 16u; // of a path's vertices
SHARED_CONST uint kGathered = kCacheInputQuads;
SHARED_CONST uint kThroughput = kCacheInputQuads + 1u;

// State of the cache between frames.
struct CacheState {
    float scale;           // what the network predicts is radiance * scale: a power of two
    float rescaling;       // the scale's change in the last frame, a factor: that of the network's last layer
    uint frames;           // with records
    float brightness;      // running mean of frameBrightness
    float frameBrightness; // of the last frame's targets: the square of the mean square root of their luminance
    float largestTarget;   // of the last frame, luminance
    uint metLight;         // paths that have gathered light themselves, since the start: 1 if any
    uint unused;
};

struct RescaleParams {
    uint quads; // of the last layer's weights
};

struct ResolveParams {
    uint factorise; // predictions are multiplied by the vertex' reflectance
};

struct RecordsParams {
    uint paths;    // training paths
    uint capacity; // of the records
    uint factorise;
    float meanDecay; // of the running mean of the brightness, per frame
};

SHARED_END
#endif
