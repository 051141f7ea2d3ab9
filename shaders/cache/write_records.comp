#version 460
#extension GL_GOOGLE_include_directive : require
// Training vertices as records for the trainer, side by side; of more than there is room for, some spread evenly over them
// are left out, so that all parts of the picture and all kinds of paths teach.
#include "lib/even_choice.glsl"
#include "lib/kernel.glsl"
#include "shared/cache.h"
#include "shared/network.h"

COUNTERS(0, counters);
QUADS_READ(1, pathSums);
WORDS_READ(2, firstRecords);
layout(set = 0, binding = 3, std430) readonly buffer TrainingVertices { vec4 trainingVertices[]; };
layout(set = 0, binding = 4, std430) readonly buffer State { CacheState cacheState; };
QUADS_WRITE(5, inputs);
QUADS_WRITE(6, targets);
layout(push_constant) uniform Push { RecordsParams params; };
#include "cache/prediction.glsl"

void main() {
    uint path = gl_GlobalInvocationID.x / kMaxTrainingVertices;
    uint vertex = gl_GlobalInvocationID.x % kMaxTrainingVertices;
    if (path >= params.paths || vertex >= loadQuad(pathSums, path).x) return;
    uint record = loadWord(firstRecords, path) + vertex;
    uint kept = counters[kRecordCounter], wanted = kept + counters[kSkippedRecords];
    if (kept < wanted) {
        if (!isEvenlyKept(record, kept, wanted)) return;
        record = evenPlace(record, kept, wanted);
    }
    if (record >= params.capacity) return;
    uint at = gl_GlobalInvocationID.x * kTrainingVertexVectors;
    vec4 quads[kCacheInputQuads];
    [[unroll]] for (uint q = 0u; q < kCacheInputQuads; ++q) {
        quads[q] = trainingVertices[at + q];
        storeQuad(inputs, quadIndex(record, q, kCacheInputQuads), floatBitsToUint(quads[q]));
    }
    vec3 factor = params.factorise != 0u ? cacheReflectance(quads[2], quads[3]) : vec3(1.0);
    vec3 target = toTarget(trainingVertices[at + kGathered].rgb, factor);
    storeQuad(targets, record, floatBitsToUint(vec4(target, 0.0)));
}
