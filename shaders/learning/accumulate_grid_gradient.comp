#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant accumulate_grid_gradient_half VALUES_IN_HALF
// Adds each row's gradient by the encoded values, times the corners' weights, to the features' sums. Sums are exact modulo
// 2^64 units, whatever the order of the rows; what is not finite adds nothing.
#include "learning/encode.glsl"

WORDS_READ(3, entries);
VALUES_READ(4, encodedGradient);
COUNTERS(5, sums);

#include "learning/grid.glsl"

layout(constant_id = kConstantOwn + 4u) const uint kFeatureCount = 0u; // where the high words begin

bool isFinite(float v) { return (floatBitsToUint(v) & 0x7f800000u) != 0x7f800000u; }

// The nearest integer, ties to even, of |v| < 2^31: small ones are left in the mantissa by adding 1.5 * 2^23, since
// conversions are scalar code on a CPU.
int nearestInteger(float v) {
    precise float shifted = v + 12582912.0;
    int nearest = floatBitsToInt(shifted) - floatBitsToInt(12582912.0);
    if (abs(v) > 4194304.0) nearest = int(roundEven(v));
    return nearest;
}

void addToSum(uint feature, float contribution) {
    int units = nearestInteger(clamp(contribution, -kLargestContribution, kLargestContribution) * kGradientUnits);
    if (units == 0) return;
    int before = int(atomicAdd(sums[feature], uint(units)));
    int after = before + units;
    bool isCarried = ((before ^ after) & (units ^ after)) < 0;
    if (isCarried) atomicAdd(sums[kFeatureCount + feature], units < 0 ? ~0u : 1u);
}

// Gradients by the values of a level.
void loadGradient(uint row, uint l, out float gradient[kFeatures]) {
    uint first = kMean ? 0u : l * kFeatures;
    [[unroll]] for (uint q = 0u; q < kLevelQuads; ++q) {
        vec4 quad = loadValues(encodedGradient, quadIndex(row, kFirstQuad + first / 4u + q, kEncodedQuads));
        [[unroll]] for (uint c = 0u; c < 4u; ++c)
            if (q * 4u + c < kFeatures) {
                float value = quad[(first + c) % 4u];
                gradient[q * 4u + c] = isFinite(value) ? levelShare() * value : 0.0;
            }
    }
}

void main() {
    uint l;
    uint row = rowAndGroup(l);
    if (row >= ROW_COUNT) return;
    loadInputs(row);
    float gradient[kFeatures];
    loadGradient(row, l, gradient);
    GridLevel level = levels[l];
    Cell cell = cellAt(gridPosition(), level);
    [[unroll]] for (uint c = 0u; c < kCorners; ++c) {
        uint entry = entryAt(level, cornerOf(cell, c));
        float weight = cornerWeight(cell, c);
        if (kGridKind != kGridSparse || entry != kAbsentEntry)
            [[unroll]] for (uint f = 0u; f < kFeatures; ++f) addToSum(entry * kFeatures + f, weight * gradient[f]);
    }
}
