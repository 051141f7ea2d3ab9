// target[i] = source[i] * factor + kAddend, by records.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(constant_id = 2) const uint kAddend = 0;
layout(push_constant) uniform Params {
    uint count;
    uint factor;
};
RECORDS_READ(0, source);
RECORDS_WRITE(1, target);

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    storeRecord(target, i, loadRecord(source, i) * factor + kAddend);
}
