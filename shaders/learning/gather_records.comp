#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : enable
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : enable
#pragma variant gather_records_by_address BY_ADDRESS
// Records of a part of the batch side by side. One with a value that is not finite or too large becomes a row of zeros and is marked.
#include "lib/kernel.glsl"
#include "lib/permutation.glsl"
#include "learning/state.glsl"
#include "shared/network.h"

STATE(0);
QUADS_READ(1, inputs);
QUADS_READ(2, targets);
QUADS_WRITE(3, batchInputs);
QUADS_WRITE(4, batchTargets);
WORDS_WRITE(5, usable); // 1 or 0 a row
layout(push_constant) uniform Push { GatherParams params; };

#ifdef BY_ADDRESS
#include "lib/store_by_address.glsl"
#define storeGathered(name, index, record) storeQuadAt(params.name, index, record)
#else
#define storeGathered(name, index, record) storeQuad(name, index, record)
#endif

uint inputQuads() { return (params.inputs + 3u) / 4u; }
uint targetQuads() { return (params.targets + 3u) / 4u; }

bool isUsable(uvec4 quad, bvec4 exists) { return isWithin(mix(vec4(0.0), uintBitsToFloat(quad), exists), params.limit); }

bool copyQuad(uint record, uint row) {
    bool usableSoFar = true;
    for (uint q = 0u; q < inputQuads(); ++q) {
        uvec4 quad = loadQuad(inputs, quadIndex(record, q, inputQuads()));
        storeGathered(batchInputs, quadIndex(row, q, inputQuads()), quad);
        usableSoFar = usableSoFar && isUsable(quad, existing(q, params.inputs));
    }
    for (uint q = 0u; q < targetQuads(); ++q) {
        uvec4 quad = loadQuad(targets, quadIndex(record, q, targetQuads()));
        storeGathered(batchTargets, quadIndex(row, q, targetQuads()), quad);
        usableSoFar = usableSoFar && isUsable(quad, existing(q, params.targets));
    }
    return usableSoFar;
}

void clearQuad(uint row) {
    for (uint q = 0u; q < inputQuads(); ++q) storeGathered(batchInputs, quadIndex(row, q, inputQuads()), uvec4(0u));
    for (uint q = 0u; q < targetQuads(); ++q) storeGathered(batchTargets, quadIndex(row, q, targetQuads()), uvec4(0u));
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (params.first + row >= state.batchRows) return;
    bool use = copyQuad(permute(state.batchFirst + params.first + row, state.records, state.permutationKey), row);
    storeWord(usable, row, use ? 1u : 0u);
    if (use) return;
    clearQuad(row);
    atomicAdd(state.droppedRecords, 1u);
}
