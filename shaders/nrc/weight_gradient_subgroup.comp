#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant weight_gradient_subgroup_half QUADS_IN_HALF
// Sum over rows of layer gradient x activation: partial sums of fixed chunks of rows. A subgroup owns 16 outputs by 4
// inputs a lane of one matrix; for each row its lanes load that row's activations, and broadcasts spread the row's
// gradients, so that nothing is summed across lanes.
#include "lib/kernel.glsl"
#include "nrc/quads.glsl"
#include "nrc/mlp_shape.glsl"

COUNTERS_READ(0, counters);
QUADS_READ(1, encoded);
QUADS_READ(2, activations);
QUADS_READ(3, layerGradients);
RECORDS_WRITE(4, partials); // a chunk after the other, each laid out as the weights
layout(push_constant) uniform Push { WeightGradientParams params; };

const uint kOutputsTogether = 16u;
const uint kQuadsTogether = kSubgroupSize;
const uint kRowsTogether = kSubgroupSize < kTileRows ? kSubgroupSize : kTileRows;

#include "nrc/weight_blocks.glsl"

vec4 gradients[kOutputsTogether / 4u]; // [quad] of the lane's row
vec4 inputs[kRowsTogether];            // [row] of the lane's quad

// Does nothing, which compilers cannot know: it keeps these arrays in memory (as in mlp_subgroup.glsl).
void keepInMemory() {
    if (params.blocks != 0u) return;
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
        gradients[params.counter + k] = vec4(0.0);
        inputs[params.counter + k] = vec4(0.0);
    }
}

void loadRows(Block b, uint row, uint end) {
    uint gradientRow = row + gl_SubgroupInvocationID % kRowsTogether;
    [[unroll]] for (uint q = 0u; q < kOutputsTogether / 4u; ++q)
        gradients[q] = q < b.gradientQuads && gradientRow < end
                           ? loadQuad(layerGradients, quadIndex(gradientRow, b.gradientQuad + q, kGradientQuads))
                           : vec4(0.0);
    // One branch around all of them: of a choice between two loads lavapipe executes both.
    if (b.isInput)
        [[unroll]] for (uint r = 0u; r < kRowsTogether; ++r)
            inputs[r] = loadQuad(encoded, quadIndex(min(row + r, end - 1u), b.activationQuad, kInputQuads));
    else
        [[unroll]] for (uint r = 0u; r < kRowsTogether; ++r)
            inputs[r] = loadQuad(activations, quadIndex(min(row + r, end - 1u), b.activationQuad, kActivationQuads));
    keepInMemory();
}

void main() {
    uint index = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID;
    uint chunk = index / params.blocks;
    if (chunk >= params.chunks) return;
    Block b = blockAt(index % params.blocks, gl_SubgroupInvocationID);
    uint row = chunk * params.chunkRows;
    uint end = min(row + params.chunkRows, ROW_COUNT);

    vec4 sums[kOutputsTogether];
    [[unroll]] for (uint o = 0u; o < kOutputsTogether; ++o) sums[o] = vec4(0.0);
    for (; row < end; row += kRowsTogether) {
        loadRows(b, row, end);
        // Four outputs by four inputs at a time, row by row: as many sums as there are registers for.
        [[unroll]] for (uint q = 0u; q < kOutputsTogether / 4u; ++q)
            [[unroll]] for (uint r = 0u; r < kRowsTogether; ++r)
                [[unroll]] for (uint c = 0u; c < 4u; ++c) sums[q * 4u + c] += subgroupBroadcast(gradients[q][c], r) * inputs[r];
    }
    if (b.quad >= b.matrixQuads) return;
    [[unroll]] for (uint o = 0u; o < kOutputsTogether; ++o)
        storeRecord(partials, (params.firstChunk + chunk) * params.weightQuads + b.matrix + (b.firstOutput + o) * b.matrixQuads + b.quad, floatBitsToUint(sums[o]));
}
