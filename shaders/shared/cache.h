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
#include "shared/cache_inputs.h"
#include "shared/cache_rule.h"
#include "shared/training_path.h"
SHARED_BEGIN

// Words of the cache's counters.
SHARED_CONST uint kQueryCounter = 0u;  // queries of the wave
SHARED_CONST uint kRecordCounter = 1u; // training records of the frame
SHARED_CONST uint kTrainingPathCounter = 2u; // training queries: one row a training path, always all of them
SHARED_CONST uint kSkippedRecords = 3u;      // of the frame: beyond the records' capacity
SHARED_CONST uint kClampedPredictions = 4u;  // since the start: not finite
SHARED_CONST uint kCacheCounters = 8u;

// Query, one row of inputs (shared/network.h's order of quads), and beside it one quad: weight rgb of the prediction,
// path index to whose radiance it is added.

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
