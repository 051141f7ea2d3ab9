#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant encode_grid_half VALUES_IN_HALF
// Features of a grid's corners about the row's point, weighted linearly in each dimension: level after level, or the levels'
// mean.
#include "learning/encode.glsl"

QUADS_READ(3, features);
WORDS_READ(4, entries);
VALUES_WRITE(5, encoded);

#include "learning/grid.glsl"

const uint kLevelsTogether = kFeatures < 4u ? 4u / kFeatures : 1u; // in a quad
const uint kValueQuads = ((kMean ? 1u : kLevels) * kFeatures + 3u) / 4u;

// The features of an entry within the quad they stand in.
vec4 alignedFeatures(vec4 quad, uint entry) {
    if (kFeatures == 1u) {
        vec2 pair = (entry & 2u) != 0u ? quad.zw : quad.xy;
        return vec4((entry & 1u) != 0u ? pair.y : pair.x);
    }
    return kFeatures == 2u && (entry & 1u) != 0u ? quad.zwxy : quad;
}

// Loads stand before the arithmetic: an image load is a call on a CPU, which spills registers.
void levelFeatures(vec3 position, uint l, out vec4 sum[kLevelQuads]) {
    GridLevel level = levels[l];
    Cell cell = cellAt(position, level);
    uint entry[kCorners];
    float weight[kCorners];
    [[unroll]] for (uint c = 0u; c < kCorners; ++c) {
        entry[c] = entryAt(level, cornerOf(cell, c));
        weight[c] = cornerWeight(cell, c);
        if (kGridKind == kGridSparse && entry[c] == kAbsentEntry) entry[c] = 0u, weight[c] = 0.0;
    }
    [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) {
        vec4 quad[kCorners];
        [[unroll]] for (uint c = 0u; c < kCorners; ++c)
            quad[c] = uintBitsToFloat(loadQuad(features, entry[c] * kFeatures / 4u + q));
        sum[q] = vec4(0.0);
        [[unroll]] for (uint c = 0u; c < kCorners; ++c) sum[q] += weight[c] * alignedFeatures(quad[c], entry[c]);
    }
}

// The levels of a group, whose values begin and end a quad.
void storeConcatenation(uint row, vec3 position, uint group) {
    vec4 quad[kLevelQuads];
    [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) quad[q] = vec4(1.0);
    [[unroll]] for (uint i = 0u; i < kLevelsTogether; ++i) {
        uint l = group * kLevelsTogether + i;
        if (l < kLevels) {
            vec4 sum[kLevelQuads];
            levelFeatures(position, l, sum);
            [[unroll]] for (uint f = 0u; f < kFeatures; ++f) quad[f / 4u][(i * kFeatures + f) % 4u] = sum[f / 4u][f % 4u];
        }
    }
    [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) storeEncoded(row, group * kLevelQuads + q, quad[q]);
}

void storeMean(uint row, vec3 position) {
    vec4 mean[kLevelQuads];
    [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) mean[q] = vec4(0.0);
    for (uint l = 0u; l < kLevels; ++l) {
        vec4 sum[kLevelQuads];
        levelFeatures(position, l, sum);
        [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) mean[q] += levelShare() * sum[q];
    }
    [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) {
        [[unroll]] for (uint c = 0u; c < 4u; ++c)
            if (q * 4u + c >= kFeatures) mean[q][c] = 1.0;
        storeEncoded(row, q, mean[q]);
    }
}

void main() {
    uint group;
    uint row = rowAndGroup(group);
    if (row >= ROW_COUNT) return;
    loadInputs(row);
    vec3 position = gridPosition();
    if (kMean) storeMean(row, position);
    else storeConcatenation(row, position, group);
    if (group == 0u)
        [[unroll]] for (uint q = 0u; q < kPaddingQuads; ++q) storeEncoded(row, kValueQuads + q, vec4(1.0));
}
