#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant encode_square_half VALUES_IN_HALF
// scale x^2: an encoding that the project does not have.
#include "learning/encode.glsl"

layout(constant_id = kConstantOwn) const float kScale = 1.0;

VALUES_WRITE(2, encoded);

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= ROW_COUNT) return;
    loadInputs(row);
    float values[kDims];
    [[unroll]] for (uint d = 0u; d < kDims; ++d) values[d] = kScale * (x[d] * x[d]);
    storeEncoding(row, values, kDims);
}
