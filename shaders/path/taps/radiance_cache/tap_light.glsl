// Light that reaches a training path while it is traced (shared/cache.h).
#ifndef IRRADIA_TAP_LIGHT_GLSL
#define IRRADIA_TAP_LIGHT_GLSL
#include "shared/cache.h"

layout(set = 0, binding = TAP_BINDING, std430) buffer PathStates { uvec4 pathStates[]; };
layout(set = 0, binding = TAP_BINDING + 1, std430) buffer TrainingPaths { uvec4 trainingPaths[]; };
layout(set = 0, binding = TAP_BINDING + 2, std430) buffer TrainingVertices { uvec4 trainingVertices[]; };

// The last recorded vertex of a training path gathers light; none does before the first is recorded.
void gather(uint training, uint vertices, vec3 light) {
    if (vertices == 0u) return;
    uint at = (training * kMaxTrainingVertices + vertices - 1u) * kTrainingVertexVectors + kGathered;
    trainingVertices[at].rgb = floatBitsToUint(uintBitsToFloat(trainingVertices[at].rgb) + light);
}

// Emission that the path's ray has met.
void hearEmission(uint path, vec3 emitted) {
    uint training = pathStates[path].z;
    if (training == 0u) return;
    uvec4 weight = trainingPaths[(training - 1u) * kTrainingPathVectors];
    gather(training - 1u, weight.w, uintBitsToFloat(weight.rgb) * emitted);
}

// The share of the light sample in flight that nothing has stopped.
void hearDirectLight(uint path, vec3 share) {
    uint training = pathStates[path].z;
    if (training == 0u) return;
    uint at = (training - 1u) * kTrainingPathVectors;
    gather(training - 1u, trainingPaths[at].w, uintBitsToFloat(trainingPaths[at + 1u].rgb) * share);
}

#endif
