// Head of the encodings: kDims consecutive inputs of a row become values from quad kFirstQuad on; what is left of the
// last quad, and kPaddingQuads quads behind it, are ones. nrc/learning/encodings/slice.cpp sets the
// constants; those of the encoding itself follow from kConstantOwn on.
#include "lib/kernel.glsl"
#include "learning/values.glsl"
#include "shared/constants.h"
#include "shared/network.h"

layout(constant_id = kConstantSliceInputQuads) const uint kInputQuads = 1u; // of a row
layout(constant_id = kConstantSliceFirstInput) const uint kFirstInput = 0u;
layout(constant_id = kConstantSliceDims) const uint kDims = 3u;
layout(constant_id = kConstantSliceEncodedQuads) const uint kEncodedQuads = 4u; // of a row of the whole composite
layout(constant_id = kConstantSliceFirstQuad) const uint kFirstQuad = 0u;
layout(constant_id = kConstantSlicePaddingQuads) const uint kPaddingQuads = 0u;

COUNTERS_READ(0, counters);
QUADS_READ(1, inputs);
layout(push_constant) uniform Push { RowsParams params; };

float x[kDims];

const uint kFirstInputQuad = kFirstInput / 4u;
const uint kSliceQuads = (kFirstInput + kDims + 3u) / 4u - kFirstInputQuad;

void loadInputs(uint row) {
    [[unroll]] for (uint q = 0u; q < kSliceQuads; ++q) {
        vec4 quad = uintBitsToFloat(loadQuad(inputs, quadIndex(row, kFirstInputQuad + q, kInputQuads)));
        [[unroll]] for (uint c = 0u; c < 4u; ++c) {
            uint i = (kFirstInputQuad + q) * 4u + c - kFirstInput; // wraps below the first
            if (i < kDims) x[i] = quad[c];
        }
    }
}

// Writes quad `q` of this encoding.
#define storeEncoded(row, q, quad) storeValues(encoded, quadIndex(row, kFirstQuad + (q), kEncodedQuads), quad)

// Writes `count` values, a constant, and the padding.
#define storeEncoding(row, values, count) \
    [[unroll]] for (uint q = 0u; q < (count + 3u) / 4u + kPaddingQuads; ++q) { \
        vec4 quad = vec4(1.0); \
        [[unroll]] for (uint c = 0u; c < 4u; ++c) \
            if (q * 4u + c < count) quad[c] = values[q * 4u + c]; \
        storeEncoded(row, q, quad); \
    }
