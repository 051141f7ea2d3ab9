// Features of a grid's corners about the row's point, weighted linearly in each dimension: level after level, or the levels'
// mean.
#include "nrc/encode.glsl"

RECORDS_READ(3, features);
WORDS_READ(4, entries);
QUADS_WRITE(5, encoded);

#include "nrc/grid.glsl"

const uint kLevelQuads = (kFeatures + 3u) / 4u;
const uint kLevelsTogether = kFeatures < 4u ? 4u / kFeatures : 1u; // in a quad
const uint kValueQuads = ((kMean ? 1u : kLevels) * kFeatures + 3u) / 4u;

// The features of an entry within the record they stand in.
vec4 alignedFeatures(vec4 record, uint entry) {
    if (kFeatures == 1u) {
        vec2 pair = (entry & 2u) != 0u ? record.zw : record.xy;
        return vec4((entry & 1u) != 0u ? pair.y : pair.x);
    }
    return kFeatures == 2u && (entry & 1u) != 0u ? record.zwxy : record;
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
        vec4 record[kCorners];
        [[unroll]] for (uint c = 0u; c < kCorners; ++c)
            record[c] = uintBitsToFloat(loadRecord(features, entry[c] * kFeatures / 4u + q));
        sum[q] = vec4(0.0);
        [[unroll]] for (uint c = 0u; c < kCorners; ++c) sum[q] += weight[c] * alignedFeatures(record[c], entry[c]);
    }
}

void storeConcatenation(uint row, vec3 position) {
    for (uint first = 0u; first < kLevels; first += kLevelsTogether) {
        vec4 quad[kLevelQuads];
        [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) quad[q] = vec4(1.0);
        [[unroll]] for (uint i = 0u; i < kLevelsTogether; ++i) {
            if (first + i < kLevels) {
                vec4 level[kLevelQuads];
                levelFeatures(position, first + i, level);
                [[unroll]] for (uint f = 0u; f < kFeatures; ++f)
                    quad[f / 4u][(i * kFeatures + f) % 4u] = level[f / 4u][f % 4u];
            }
        }
        [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) storeEncoded(row, first * kFeatures / 4u + q, quad[q]);
    }
}

void storeMean(uint row, vec3 position) {
    vec4 sum[kLevelQuads];
    [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) sum[q] = vec4(0.0);
    for (uint l = 0u; l < kLevels; ++l) {
        vec4 level[kLevelQuads];
        levelFeatures(position, l, level);
        [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) sum[q] += level[q];
    }
    [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) {
        vec4 quad = vec4(1.0);
        [[unroll]] for (uint c = 0u; c < 4u; ++c)
            if (q * 4u + c < kFeatures) quad[c] = levelShare() * sum[q][c];
        storeEncoded(row, q, quad);
    }
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= counters[params.counter]) return;
    loadInputs(row);
    vec3 position = gridPosition();
    if (kMean) storeMean(row, position);
    else storeConcatenation(row, position);
    [[unroll]] for (uint q = 0u; q < kPaddingQuads; ++q) storeEncoded(row, kValueQuads + q, vec4(1.0));
}
