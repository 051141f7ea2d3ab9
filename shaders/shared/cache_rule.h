// Where paths ask a radiance cache and end, and what a path keeps of it from vertex to vertex.
#ifndef IRRADIA_SHARED_CACHE_RULE_H
#define IRRADIA_SHARED_CACHE_RULE_H
#include "shared/types.h"
SHARED_BEGIN

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

SHARED_END
#endif
