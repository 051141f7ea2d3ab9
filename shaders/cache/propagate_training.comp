#version 460
#extension GL_GOOGLE_include_directive : require
// Carries radiance back along each training path, from where it ended: gathered light becomes the targets.
#include "lib/kernel.glsl"
#include "shared/cache.h"
#include "shared/network.h"

COUNTERS(0, counters);
layout(set = 0, binding = 1, std430) readonly buffer TrainingPaths { uvec4 trainingPaths[]; };
layout(set = 0, binding = 2, std430) buffer TrainingVertices { vec4 trainingVertices[]; };
QUADS_READ(3, queries); // of the training paths
QUADS_READ(4, results);
layout(set = 0, binding = 5, std430) readonly buffer State { CacheState cacheState; };
// Per path: records (uint), of the targets' luminance the roots' sum and the largest, 1 (uint) if it has gathered light.
QUADS_WRITE(6, pathSums);
layout(push_constant) uniform Push { RecordsParams params; };
#include "cache/prediction.glsl"

void main() {
    uint path = gl_GlobalInvocationID.x;
    if (path >= params.paths) return;
    uint vertices = trainingPaths[path * kTrainingPathVectors].w;
    vec3 l = vec3(0.0);
    bool endsInCache = trainingPaths[path * kTrainingPathVectors + 1u].w != 0u;
    if (endsInCache && cacheState.frames > 0u) { // before, the cache knows nothing
        vec3 factor = REFLECTANCE(queries, path);
        l = toRadiance(uintBitsToFloat(loadQuad(results, path).rgb), params.factorise != 0u ? factor : vec3(1.0));
    }
    float rootSum = 0.0, largest = 0.0;
    bool gathers = false;
    for (uint i = vertices; i > 0u; --i) {
        uint at = (path * kMaxTrainingVertices + i - 1u) * kTrainingVertexVectors;
        vec3 gathered = trainingVertices[at + kGathered].rgb;
        gathers = gathers || any(greaterThan(gathered, vec3(0.0)));
        l = gathered + trainingVertices[at + kThroughput].rgb * l;
        trainingVertices[at + kGathered].rgb = l;
        float y = luminance(l);
        rootSum += y >= 0.0 && y < 1e15 ? sqrt(y) : 0.0; // what is not finite the trainer drops and counts
        largest = max(largest, y);
    }
    storeQuad(pathSums, path, uvec4(vertices, floatBitsToUint(rootSum), floatBitsToUint(largest), gathers ? 1u : 0u));
}
