#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant encode_one_blob_half VALUES_IN_HALF
// Mass of a kernel of width 1 / kBins about each input in kBins equal bins of [0, 1] (Müller et al. 2019): a Gaussian's, or
// that of the quartic kernel (2021). What lies outside [0, 1] is lost: nothing wraps around or piles up at the borders.
#include "learning/encode.glsl"
#include "lib/encoding.glsl"

layout(constant_id = kConstantOwn) const uint kBins = 4u;
layout(constant_id = kConstantOwn + 1u) const bool kGaussian = false;

VALUES_WRITE(2, encoded);

const uint kValues = kDims * kBins;

float kernelCdf(float u) { return kGaussian ? gaussianCdf(u) : quarticCdf(u); }

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= ROW_COUNT) return;
    loadInputs(row);
    float values[kValues];
    [[unroll]] for (uint d = 0u; d < kDims; ++d) {
        float centre = x[d] * float(kBins);
        float below = kernelCdf(-centre);
        [[unroll]] for (uint i = 0u; i < kBins; ++i) {
            float above = kernelCdf(float(i + 1u) - centre);
            values[d * kBins + i] = above - below;
            below = above;
        }
    }
    storeEncoding(row, values, kValues);
}
