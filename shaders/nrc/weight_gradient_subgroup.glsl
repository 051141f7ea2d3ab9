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
const uint kRowsTogether = kSubgroupSize < kTileRows ? kSubgroupSize : kTileRows;

// A block of one matrix of the network.
struct Block {
    uint matrix; // first quad in the weights
    uint inputQuads; // of the matrix
    uint firstOutput;
    uint quad; // this lane's inputs
    uint gradientQuad; // of firstOutput in a row of layerGradients
    uint gradientQuads; // that exist from there on
    uint activationQuad; // of this lane in a row of activations (or of the encoded inputs, where isInput)
    bool isInput;
};

uint blocksAcross(uint quads) { return (quads + kSubgroupSize - 1u) / kSubgroupSize; }

Block blockAt(uint index) {
    uint down = kWidthQuads * 4u / kOutputsTogether;
    uint first = down * blocksAcross(kInputQuads), hidden = down * blocksAcross(kWidthQuads);
    uint layer = index < first ? 0u : 1u + (index - first) / hidden;
    uint within = layer == 0u ? index : (index - first) % hidden;

    Block b;
    b.isInput = layer == 0u;
    b.inputQuads = b.isInput ? kInputQuads : kWidthQuads;
    uint across = blocksAcross(b.inputQuads);
    b.matrix = b.isInput ? kInputMatrix : kHiddenMatrices + (layer - 1u) * kHiddenMatrixQuads;
    b.firstOutput = within / across * kOutputsTogether;
    b.quad = within % across * kSubgroupSize + gl_SubgroupInvocationID;
    b.gradientQuad = layer * kWidthQuads + b.firstOutput / 4u;
    b.gradientQuads = layer == kHiddenLayers ? kOutputQuads : kOutputsTogether / 4u;
    b.activationQuad = b.isInput ? b.quad : (layer - 1u) * kWidthQuads + b.quad;
    return b;
}

vec4 activationOf(Block b, uint row) {
    return b.isInput ? loadQuad(encoded, quadIndex(row, b.activationQuad, kInputQuads))
                     : loadQuad(activations, quadIndex(row, b.activationQuad, kActivationQuads));
}

void main() {
    uint index = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID;
    uint chunk = index / params.blocks;
    if (chunk >= kGradientChunks) return;
    Block b = blockAt(index % params.blocks);
    uint row = chunk * params.chunkRows;
    uint end = min(row + params.chunkRows, counters[params.counter]);

    vec4 sums[kOutputsTogether];
    [[unroll]] for (uint o = 0u; o < kOutputsTogether; ++o) sums[o] = vec4(0.0);
    for (; row < end; row += kRowsTogether) {
        vec4 gradients[kOutputsTogether / 4u];
        vec4 inputs[kRowsTogether];
        uint gradientRow = row + gl_SubgroupInvocationID % kRowsTogether;
        [[unroll]] for (uint q = 0u; q < kOutputsTogether / 4u; ++q)
            gradients[q] = q < b.gradientQuads && gradientRow < end
                               ? loadQuad(layerGradients, quadIndex(gradientRow, b.gradientQuad + q, kGradientQuads))
                               : vec4(0.0);
        [[unroll]] for (uint r = 0u; r < kRowsTogether; ++r) inputs[r] = activationOf(b, min(row + r, end - 1u));
        [[unroll]] for (uint o = 0u; o < kOutputsTogether; ++o)
            [[unroll]] for (uint r = 0u; r < kRowsTogether; ++r)
                sums[o] += subgroupBroadcast(gradients[o / 4u][o % 4u], r) * inputs[r];
    }
    if (b.quad >= b.inputQuads) return;
    [[unroll]] for (uint o = 0u; o < kOutputsTogether; ++o)
        storeRecord(partials, chunk * params.weightQuads + b.matrix + (b.firstOutput + o) * b.inputQuads + b.quad, floatBitsToUint(sums[o]));
}
