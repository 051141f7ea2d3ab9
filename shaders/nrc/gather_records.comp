#version 460
#extension GL_GOOGLE_include_directive : require
// The batch's records side by side. One with a value that is not finite or too large becomes a row of zeros and is marked.
#include "lib/kernel.glsl"
#include "lib/permutation.glsl"
#include "nrc/state.glsl"
#include "shared/network.h"

STATE(0);
RECORDS_READ(1, inputs);
RECORDS_READ(2, targets);
RECORDS_WRITE(3, batchInputs);
RECORDS_WRITE(4, batchTargets);
WORDS_WRITE(5, usable); // 1 or 0 a row
layout(push_constant) uniform Push { GatherParams params; };

bool isUsable(uint record) {
    bool usableSoFar = true;
    for (uint q = 0u; q < params.inputQuads; ++q)
        usableSoFar = usableSoFar && isWithin(uintBitsToFloat(loadRecord(inputs, quadIndex(record, q, params.inputQuads))), params.limit);
    for (uint q = 0u; q < params.targetQuads; ++q)
        usableSoFar = usableSoFar && isWithin(uintBitsToFloat(loadRecord(targets, quadIndex(record, q, params.targetQuads))), params.limit);
    return usableSoFar;
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= state.batchRows) return;
    uint record = permute(state.batchFirst + row, state.records, state.permutationKey);
    bool use = isUsable(record);
    for (uint q = 0u; q < params.inputQuads; ++q)
        storeRecord(batchInputs, quadIndex(row, q, params.inputQuads), use ? loadRecord(inputs, quadIndex(record, q, params.inputQuads)) : uvec4(0u));
    for (uint q = 0u; q < params.targetQuads; ++q)
        storeRecord(batchTargets, quadIndex(row, q, params.targetQuads), use ? loadRecord(targets, quadIndex(record, q, params.targetQuads)) : uvec4(0u));
    storeWord(usable, row, use ? 1u : 0u);
    if (!use) atomicAdd(state.droppedRecords, 1u);
}
