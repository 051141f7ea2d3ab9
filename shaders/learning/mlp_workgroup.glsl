// The fused perceptron for devices with fast shared memory (GPUs). A workgroup owns a tile of kGroupRows rows: their
// activations stay in shared memory through all layers, and a layer's weights pass through it in blocks of kBlockOutputs
// outputs (one block where the layer fits). A thread computes 4 rows by some quads of outputs.
layout(constant_id = kConstantGroupRows) const uint kGroupRows = 64u;
layout(constant_id = kConstantGroupOutputs) const uint kBlockOutputs = 64u;

const uint kThreadRows = 4u;
const uint kRowThreads = kGroupRows / kThreadRows;
const uint kBlockQuads = kBlockOutputs / 4u;
const uint kQuadThreads = kBlockQuads < 8u ? kBlockQuads : 8u; // the workgroup is kRowThreads * kQuadThreads threads
const uint kThreadQuads = kBlockQuads / kQuadThreads;
const uint kLayerBlocks = kWidthQuads / kBlockQuads;

#ifdef VALUES_IN_HALF
#define SharedQuad uvec2
SharedQuad toShared(vec4 v) { return uvec2(packHalf2x16(v.xy), packHalf2x16(v.zw)); }
vec4 fromShared(SharedQuad v) { return vec4(unpackHalf2x16(v.x), unpackHalf2x16(v.y)); }
#else
#define SharedQuad vec4
SharedQuad toShared(vec4 v) { return v; }
vec4 fromShared(SharedQuad v) { return v; }
#endif

shared SharedQuad rowQuads[kGroupRows * kLargestQuads];       // [quad][row]: neighbouring threads, neighbouring words
shared SharedQuad weightQuads[kBlockOutputs * kLargestQuads]; // [quad][output]

vec4 sums[kThreadRows * kThreadQuads];                // of one block
vec4 layerSums[kThreadRows * kThreadQuads * kLayerBlocks]; // of a hidden layer, until all threads have read its inputs

uint firstRow() { return gl_WorkGroupID.x * kGroupRows; }
uint rowOfThread(uint k) { return gl_LocalInvocationID.x % kRowThreads + k * kRowThreads; }
uint quadOfThread(uint m) { return gl_LocalInvocationID.x / kRowThreads + m * kQuadThreads; } // in a block

// The block of a matrix with `outputs` rows of `quads` quads, from firstOutput on; outputs beyond the matrix read as zero.
void loadWeights(uint matrix, uint quads, uint outputs, uint firstOutput) {
    for (uint i = gl_LocalInvocationID.x; i < kBlockOutputs * quads; i += kRowThreads * kQuadThreads) {
        uint o = firstOutput + i % kBlockOutputs;
        weightQuads[i] = o < outputs ? toShared(loadValues(packed, matrix + quadIndex(o, i / kBlockOutputs, quads)))
                                     : toShared(vec4(0.0));
    }
}

void multiplyBlock(uint matrix, uint quads, uint outputs, uint firstOutput) {
    barrier(); // the last block's weights have been read
    loadWeights(matrix, quads, outputs, firstOutput);
    barrier();
    [[unroll]] for (uint k = 0u; k < kThreadRows * kThreadQuads; ++k) sums[k] = vec4(0.0);
    for (uint q = 0u; q < quads; ++q) {
        vec4 x[kThreadRows];
        [[unroll]] for (uint k = 0u; k < kThreadRows; ++k) x[k] = fromShared(rowQuads[q * kGroupRows + rowOfThread(k)]);
        [[unroll]] for (uint m = 0u; m < kThreadQuads; ++m)
            [[unroll]] for (uint c = 0u; c < 4u; ++c) {
                vec4 w = fromShared(weightQuads[q * kBlockOutputs + quadOfThread(m) * 4u + c]);
                [[unroll]] for (uint k = 0u; k < kThreadRows; ++k) sums[k * kThreadQuads + m][c] += dot(w, x[k]);
            }
    }
}

// layerSums of block `b` = sums, at constant indices.
void appendBlock(uint b) {
    [[unroll]] for (uint constant = 0u; constant < kLayerBlocks; ++constant)
        if (b == constant)
            [[unroll]] for (uint k = 0u; k < kThreadRows * kThreadQuads; ++k)
                layerSums[constant * kThreadRows * kThreadQuads + k] = sums[k];
}

// A layer of at most kWidthQuads * 4 outputs into layerSums. The next layer's inputs are theirs to write, after a barrier.
// Called from one place, for all layers, and not unrolled over blocks: lavapipe takes seconds to compile each copy.
void multiplyLayer(uint matrix, uint quads, uint outputs) {
    [[dont_unroll]] for (uint b = 0u; b * kBlockOutputs < outputs; ++b) {
        multiplyBlock(matrix, quads, outputs, b * kBlockOutputs);
        appendBlock(b);
    }
    barrier();
}

// Loops over what a thread owns of a layer: body sees its row in the tile, its quad in the layer and its sum.
#define FOR_LAYER_SUMS(row, quad, sum, body)                                                                 \
    [[unroll]] for (uint b_ = 0u; b_ < kLayerBlocks; ++b_)                                                   \
        [[unroll]] for (uint k_ = 0u; k_ < kThreadRows; ++k_)                                                \
            [[unroll]] for (uint m_ = 0u; m_ < kThreadQuads; ++m_) {                                         \
                uint row = rowOfThread(k_);                                                                  \
                uint quad = b_ * kBlockQuads + quadOfThread(m_);                                             \
                vec4 sum = layerSums[(b_ * kThreadRows + k_) * kThreadQuads + m_];                           \
                body                                                                                         \
            }
