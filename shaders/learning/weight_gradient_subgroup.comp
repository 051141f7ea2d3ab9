#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant weight_gradient_subgroup_half VALUES_IN_HALF
// Sum over rows of layer gradient x activation: partial sums of fixed chunks of rows. A subgroup owns a block of outputs by
// 4 inputs a lane of one matrix; for each row its lanes load that row's activations, and broadcasts spread the row's
// gradients, so that nothing is summed across lanes. The more outputs, the fewer loads for each product.
#include "lib/kernel.glsl"
#include "learning/values.glsl"
#include "learning/mlp_shape.glsl"

COUNTERS_READ(0, counters);
VALUES_READ(1, encoded);
VALUES_READ(2, activations);
VALUES_READ(3, layerGradients);
QUADS_WRITE(4, partials); // a chunk after the other, each laid out as the weights
layout(push_constant) uniform Push { WeightGradientParams params; };

layout(constant_id = kConstantOutputsTogether) const uint kOutputsTogether = 16u;
const uint kOutputQuadsTogether = kOutputsTogether / 4u;
const uint kQuadsTogether = kSubgroupSize;
const uint kRowsTogether = kSubgroupSize < kTileRows ? kSubgroupSize : kTileRows;
const uint kQuadsAtOnce = kSubgroupSize / kRowsTogether; // of these rows' gradients, that all lanes load

#include "learning/weight_blocks.glsl"

const uint kGradientLoads = (kOutputQuadsTogether + kQuadsAtOnce - 1u) / kQuadsAtOnce;

vec4 gradients[kGradientLoads];
vec4 inputs[kRowsTogether]; // [row] of the lane's quad

// Does nothing, which compilers cannot know: it keeps these arrays in memory (as in mlp_subgroup.glsl).
void keepInMemory() {
    if (params.blocks != 0u) return;
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
        gradients[params.counter + k] = vec4(0.0);
        inputs[params.counter + k] = vec4(0.0);
    }
}

// Row of a tile's first half or second (a cache line each) in turn: lines that are not near are waited for together.
uint rowInTurn(uint k) { return k / 2u + k % 2u * (kRowsTogether / 2u); }

void loadRows(Block b, uint row, uint end) {
    // One branch around all of them: of a choice between two loads lavapipe executes both.
    if (b.isInput)
        [[unroll]] for (uint k = 0u; k < kRowsTogether; ++k)
            inputs[rowInTurn(k)] = loadValues(encoded, quadIndex(min(row + rowInTurn(k), end - 1u), b.activationQuad, kInputQuads));
    else
        [[unroll]] for (uint k = 0u; k < kRowsTogether; ++k)
            inputs[rowInTurn(k)] = loadValues(activations, quadIndex(min(row + rowInTurn(k), end - 1u), b.activationQuad, kActivationQuads));
    uint gradientRow = row + gl_SubgroupInvocationID % kRowsTogether;
    [[unroll]] for (uint i = 0u; i < kGradientLoads; ++i) {
        uint quad = b.gradientQuad + min(i * kQuadsAtOnce + gl_SubgroupInvocationID / kRowsTogether, b.gradientQuads - 1u);
        gradients[i] = mix(vec4(0.0), loadValues(layerGradients, quadIndex(min(gradientRow, end - 1u), quad, kGradientQuads)),
                           bvec4(gradientRow < end));
    }
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
        [[unroll]] for (uint q = 0u; q < kOutputQuadsTogether; ++q)
            if (q < b.gradientQuads)
                [[unroll]] for (uint r = 0u; r < kRowsTogether; ++r)
                    [[unroll]] for (uint c = 0u; c < 4u; ++c)
                        sums[q * 4u + c] +=
                            subgroupBroadcast(gradients[q / kQuadsAtOnce][c], r + q % kQuadsAtOnce * kRowsTogether) * inputs[r];
    }
    if (b.quad >= b.matrixQuads) return;
    uint outputs = max(b.gradientQuads * 4u, kFeaturePadding); // the output matrix has fewer than a block
    [[unroll]] for (uint o = 0u; o < kOutputsTogether; ++o)
        if (o < outputs)
            storeQuad(partials, (params.firstChunk + chunk) * params.weightQuads + b.matrix + (b.firstOutput + o) * b.matrixQuads + b.quad, floatBitsToUint(sums[o]));
}
