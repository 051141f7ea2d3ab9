#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant encode_identity_half VALUES_IN_HALF
// scale x + offset.
#include "learning/encode.glsl"

layout(constant_id = kConstantOwn) const float kScale = 1.0;
layout(constant_id = kConstantOwn + 1u) const float kOffset = 0.0;

VALUES_WRITE(2, encoded);

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= ROW_COUNT) return;
    loadInputs(row);
    float values[kDims];
    [[unroll]] for (uint d = 0u; d < kDims; ++d) values[d] = kScale * x[d] + kOffset;
    storeEncoding(row, values, kDims);
}
