// The fused perceptron for wide SIMD with few barriers (CPUs). A lane owns kRows rows, whose activations it keeps to
// itself; a subgroup goes through the same weights together, four outputs at a time. The lanes that share an output load
// parts of its weights in turn, and broadcasts spread them. Four outputs of four rows are sums enough to fill a CPU's
// vector registers, and their unrolled code stays in its instruction cache, which that of eight outputs does not.
layout(constant_id = kConstantLaneRows) const uint kRows = 4u; // per lane; changes no result

const uint kBlock = 4u; // outputs computed together: a quad of each row
const uint kLanesPerOutput = kSubgroupSize / kBlock;

vec4 layerIn[kRows * kLargestQuads]; // [row][quad]
vec4 layerOut[kRows * kWidthQuads];
vec4 weights[(kLargestQuads + kLanesPerOutput - 1u) / kLanesPerOutput]; // of this lane's output
vec4 block[kRows];

// First row of this lane; the others follow at kSubgroupSize.
uint firstRow() {
    uint subgroup = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID;
    return subgroup * kSubgroupSize * kRows + gl_SubgroupInvocationID;
}

// Does nothing, which compilers cannot know: an index of run time keeps these arrays in memory. As registers they would be
// hundreds, spilled in bulk; in memory, a weight's broadcast is part of its load. It stands behind the loads of weights, or
// their values would pass it by. (Fewer than eight statements run under a mask in lavapipe, instead of being branched over.)
void keepInMemory() {
    if (params.capacity != 0u) return;
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
        layerIn[params.counter + k] = vec4(0.0);
        layerOut[params.counter + k] = vec4(0.0);
        weights[params.counter + k] = vec4(0.0);
    }
}

// block = outputs [4 quad, 4 quad + 4) of the matrix at `matrix` with rows of `quads` quads (a constant).
void multiplyBlock(uint matrix, uint quads, uint quad) {
    uint column = matrix + quadIndex(quad * kBlock + gl_SubgroupInvocationID % kBlock, 0u, quads);
    uint part = gl_SubgroupInvocationID / kBlock;
    [[unroll]] for (uint i = 0u; i < (quads + kLanesPerOutput - 1u) / kLanesPerOutput; ++i)
        weights[i] = loadValues(packed, column + min(i * kLanesPerOutput + part, quads - 1u) * kTileRows);
    keepInMemory();
    [[unroll]] for (uint r = 0u; r < kRows; ++r) block[r] = vec4(0.0);
    [[unroll]] for (uint i = 0u; i < quads; ++i)
        [[unroll]] for (uint c = 0u; c < 4u; ++c)
            [[unroll]] for (uint n = 0u; n < kBlock; ++n) {
                float w = subgroupBroadcast(weights[i / kLanesPerOutput][c], n + i % kLanesPerOutput * kBlock);
                [[unroll]] for (uint r = 0u; r < kRows; ++r) block[r][n] += w * layerIn[r * kLargestQuads + i][c];
            }
}

// layerOut[quad] of each row = block. Branches to constant indices: lavapipe writes to an index of run time lane by lane.
void appendBlock(uint quad) {
    [[unroll]] for (uint four = 0u; four < kWidthQuads / 4u; ++four)
        if (quad / 4u == four)
            [[unroll]] for (uint k = 0u; k < 4u; ++k)
                if (quad % 4u == k)
                    [[unroll]] for (uint r = 0u; r < kRows; ++r) layerOut[r * kWidthQuads + four * 4u + k] = block[r];
}

void nextLayer() {
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        [[unroll]] for (uint i = 0u; i < kWidthQuads; ++i) layerIn[r * kLargestQuads + i] = layerOut[r * kWidthQuads + i];
}
