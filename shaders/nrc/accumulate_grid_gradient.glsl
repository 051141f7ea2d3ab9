// Adds each row's gradient by the encoded values, times the corners' weights, to the features' sums. Sums are exact modulo
// 2^64 units, whatever the order of the rows; what is not finite adds nothing.
#include "nrc/encode.glsl"

WORDS_READ(3, entries);
QUADS_READ(4, encodedGradient);
COUNTERS(5, sums);

#include "nrc/grid.glsl"

layout(constant_id = 12) const uint kFeatureCount = 0u; // where the high words begin

bool isFinite(float v) { return (floatBitsToUint(v) & 0x7f800000u) != 0x7f800000u; }

void addToSum(uint feature, float contribution) {
    float cut = clamp(contribution, -kLargestContribution, kLargestContribution);
    int units = int(roundEven(cut * kGradientUnits));
    if (units == 0) return;
    int before = int(atomicAdd(sums[feature], uint(units)));
    int after = before + units;
    if (((before ^ after) & (units ^ after)) < 0) atomicAdd(sums[kFeatureCount + feature], units < 0 ? ~0u : 1u);
}

// Gradients by the values of a level.
void loadGradient(uint row, uint l, out float gradient[kFeatures]) {
    uint first = kMean ? 0u : l * kFeatures;
    [[unroll]] for (uint f = 0u; f < kFeatures; f += 4u) {
        vec4 quad = loadQuad(encodedGradient, quadIndex(row, kFirstQuad + (first + f) / 4u, kEncodedQuads));
        [[unroll]] for (uint c = 0u; c < 4u && f + c < kFeatures; ++c) {
            float value = quad[(first + c) % 4u];
            gradient[f + c] = isFinite(value) ? levelShare() * value : 0.0;
        }
    }
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= counters[params.counter]) return;
    loadInputs(row);
    vec3 position = gridPosition();
    for (uint l = 0u; l < kLevels; ++l) {
        float gradient[kFeatures];
        loadGradient(row, l, gradient);
        GridLevel level = levels[l];
        Cell cell = cellAt(position, level);
        [[unroll]] for (uint c = 0u; c < kCorners; ++c) {
            uint entry = entryAt(level, cornerOf(cell, c));
            if (kGridKind == kGridSparse && entry == kAbsentEntry) continue;
            float weight = cornerWeight(cell, c);
            [[unroll]] for (uint f = 0u; f < kFeatures; ++f) addToSum(entry * kFeatures + f, weight * gradient[f]);
        }
    }
}
