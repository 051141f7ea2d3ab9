#version 460
#extension GL_GOOGLE_include_directive : require
// The share of the records that one optimisation step takes: `batches` shares of a permutation that is new for each pass.
#include "lib/kernel.glsl"
#include "lib/permutation.glsl"
#include "learning/state.glsl"

STATE(0);
COUNTERS_READ(1, counters);
layout(push_constant) uniform Push { BeginBatchParams params; };

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    if (params.batch == 0u) {
        state.records = min(counters[params.counter], params.capacity);
        state.permutationKey = mixBits(params.seed ^ mixBits(state.steps));
    }
    uint share = state.records / params.batches, rest = state.records % params.batches;
    state.batchFirst = share * params.batch + min(rest, params.batch);
    state.batchRows = share + (params.batch < rest ? 1u : 0u);
}
