// State and parameters of training: what decides a step lives on the device, so that a batch whose size the device found
// needs no word from the host.
#ifndef IRRADIA_SHARED_TRAINING_H
#define IRRADIA_SHARED_TRAINING_H
#include "shared/types.h"
SHARED_BEGIN

struct TrainingState {
    // Since the start.
    uint steps;             // that changed the parameters
    uint droppedRecords;    // not finite or too large, or with a prediction or loss that is
    uint clippedSteps;      // whose gradient was longer than the clip
    uint damagedParameters; // found not finite or beyond kParameterLimit, and set to zero
    float learningRateFactor; // of the decay schedule
    float eta1;               // 1 - beta1^steps
    float eta2;               // 1 - beta2^steps
    float etaEma;             // 1 - alpha^steps
    // Of the current pass over the records, and of its current batch.
    uint records;
    uint permutationKey;
    uint batchFirst; // position in the permutation
    uint batchRows;
    uint validRecords;
    uint applied;         // 1 where the batch changes the parameters
    float etaEmaBefore;   // etaEma of the step before
    float gradientScale;  // 1 / (valid records * outputs * loss scale)
    float clipScale;      // at most 1
    float loss;           // mean over valid records and outputs
    // Of the first pass' batches so far, the mean over usable records of their luminance (of other than 3 outputs: their
    // mean): what was predicted before each step, and what was to be predicted.
    float meanPrediction;
    float meanTarget;
};
// Words of it that generic kernels are pointed to.
SHARED_CONST uint kBatchRowsWord = 11u;
SHARED_CONST uint kGradientScaleWord = 15u;

// A value beyond its limit counts as not finite.
SHARED_CONST float kParameterLimit = 1e6f;
SHARED_CONST float kPredictionLimit = 1e15f; // its square, of which losses are relative, stays finite
SHARED_CONST float kGradientLimit = 1e15f; // its square, summed over all parameters, stays finite
SHARED_CONST float kMomentLimit = 1e30f;

struct BeginBatchParams {
    uint counter; // word of the records' counters
    uint capacity;
    uint batch; // of `batches`
    uint batches;
    uint seed;
};

struct GatherParams {
    uint inputs; // of a record
    uint targets;
    float limit; // of a record's values
    uint first;  // row of the part
    uvec2 batchInputs; // addresses, where the kernel stores by them
    uvec2 batchTargets;
};

// loss: kinds, kConstantLoss
SHARED_CONST uint kLossL2 = 0u;
SHARED_CONST uint kLossRelativeL2 = 1u;
SHARED_CONST uint kLossRelativeL2Luminance = 2u;
struct LossParams {
    float epsilon;
    float exponentStart;
    float exponentEnd;
    uint annealStart;
    uint annealEnd;
    float lossScale;
    float gradientLimit; // of a result's gradient, scaled
    uint first; // row
};

struct EndBatchParams {
    uint outputs;
    float lossScale;
    uint batch; // of the first pass over the records; kLaterPass = of another
};
SHARED_CONST uint kLaterPass = 0xffffffffu;

SHARED_CONST uint kNormPartials = 64u; // workgroups of gradient_norm for each group of parameters
struct NormParams {
    uint quads;
    uint firstPartial;
};

struct BeginUpdateParams {
    uint partials; // of the squared norm; 0 = no clip
    float clipNorm;
    float beta1;
    float beta2;
    float emaDecay;
    float decayBase;
    uint decayStart;
    uint decayInterval; // 0 = never
    uint decayEnd;
};

struct OptimizeParams {
    uint quads;
    float learningRate;
    float beta1;
    float beta2;
    float epsilon;
    float l2;
    float emaDecay;
    uint unused;
    uvec2 values; // addresses, where the kernel stores by them
    uvec2 firstMoments;
    uvec2 secondMoments;
    uvec2 averages;
    uvec2 gradients;
};

SHARED_END
#endif
