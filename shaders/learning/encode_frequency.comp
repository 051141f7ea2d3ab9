#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant encode_frequency_half VALUES_IN_HALF
// Per input sin(2^k pi x) and cos(2^k pi x) for k < kFrequencies (Mildenhall et al. 2020, eq. 4), or in their stead
// triangle(2^k x) alone (Müller et al. 2021).
#include "learning/encode.glsl"
#include "lib/encoding.glsl"

layout(constant_id = kConstantOwn) const uint kFrequencies = 12u;
layout(constant_id = kConstantOwn + 1u) const bool kTriangle = true;

VALUES_WRITE(2, encoded);

const uint kValues = kDims * kFrequencies * (kTriangle ? 1u : 2u);

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= ROW_COUNT) return;
    loadInputs(row);
    float values[kValues];
    [[unroll]] for (uint d = 0u; d < kDims; ++d)
        [[unroll]] for (uint k = 0u; k < kFrequencies; ++k) {
            uint i = d * kFrequencies + k;
            float scaled = float(1u << k) * x[d];
            if (kTriangle) {
                values[i] = triangleWave(scaled);
            } else {
                values[2u * i] = sinPi(scaled);
                values[2u * i + 1u] = cosPi(scaled);
            }
        }
    storeEncoding(row, values, kValues);
}
