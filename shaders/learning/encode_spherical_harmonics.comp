#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant encode_spherical_harmonics_half VALUES_IN_HALF
// The kDegree^2 harmonics of bands below kDegree of a unit direction, given by its components in [-1, 1].
#include "learning/encode.glsl"
#include "lib/encoding.glsl"

layout(constant_id = kConstantOwn) const uint kDegree = 4u;

VALUES_WRITE(2, encoded);

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= ROW_COUNT) return;
    loadInputs(row);
    float values[16];
    sphericalHarmonics(vec3(x[0], x[1], x[2]), values);
    storeEncoding(row, values, kDegree * kDegree);
}
