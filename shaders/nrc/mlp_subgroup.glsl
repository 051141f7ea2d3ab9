// The fused perceptron for wide SIMD with few barriers (CPUs). A lane owns kRows rows, whose activations stay in its
// registers; a subgroup goes through the same weights together: each lane loads those of one output, and broadcasts spread
// them. Loads are issued before the arithmetic that uses them: an image load is a call there, which spills registers.
layout(constant_id = 7) const uint kRows = 4u; // per lane; changes no result

const uint kBlock = kSubgroupSize < kTileRows ? kSubgroupSize : kTileRows; // outputs computed together
const uint kBlockQuads = kBlock / 4u;

vec4 layerIn[kRows * kLargestQuads]; // [row][quad]
vec4 layerOut[kRows * kLargestQuads];
vec4 block[kRows * kBlockQuads];

// First row of this lane; the others follow at kSubgroupSize.
uint firstRow() {
    uint subgroup = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID;
    return subgroup * kSubgroupSize * kRows + gl_SubgroupInvocationID;
}

// block = outputs [firstOutput, firstOutput + kBlock) of the matrix at `matrix` with rows of `quads` quads (a constant).
void multiplyBlock(uint matrix, uint quads, uint firstOutput) {
    vec4 weights[kLargestQuads];
    uint column = matrix + quadIndex(firstOutput + gl_SubgroupInvocationID % kBlock, 0u, quads);
    [[unroll]] for (uint i = 0u; i < quads; ++i) weights[i] = loadQuad(packed, column + i * kTileRows);
    [[unroll]] for (uint k = 0u; k < kRows * kBlockQuads; ++k) block[k] = vec4(0.0);
    [[unroll]] for (uint i = 0u; i < quads; ++i)
        [[unroll]] for (uint n = 0u; n < kBlock; ++n) {
            vec4 w = subgroupBroadcast(weights[i], n);
            [[unroll]] for (uint r = 0u; r < kRows; ++r)
                block[r * kBlockQuads + n / 4u][n % 4u] += dot(w, layerIn[r * kLargestQuads + i]);
        }
}

// The index that depends on a loop keeps both arrays in memory: as hundreds of registers carried around the loop they
// are spilled in bulk, and a kernel takes 2-3 times as long and up to 40 s to compile.
void appendBlock(uint firstOutput) {
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        [[unroll]] for (uint j = 0u; j < kBlockQuads; ++j)
            layerOut[r * kLargestQuads + firstOutput / 4u + j] = block[r * kBlockQuads + j];
}

void nextLayer(uint quads) {
    [[unroll]] for (uint r = 0u; r < kRows; ++r)
        [[unroll]] for (uint i = 0u; i < quads; ++i) layerIn[r * kLargestQuads + i] = layerOut[r * kLargestQuads + i];
}
