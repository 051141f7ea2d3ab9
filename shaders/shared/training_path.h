// What training paths leave behind for a cache to learn from (the contract: shared/cache.h).
#ifndef IRRADIA_SHARED_TRAINING_PATH_H
#define IRRADIA_SHARED_TRAINING_PATH_H
#include "shared/cache_inputs.h"
SHARED_BEGIN

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

SHARED_END
#endif
