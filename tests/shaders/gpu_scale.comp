// target[i] = source[i] * factor + kAddend, by records.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(constant_id = 2) const uint kAddend = 0;
layout(push_constant) uniform Params {
    uint count;
    uint factor;
};
QUADS_READ(0, source);
QUADS_WRITE(1, target);

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    storeQuad(target, i, loadQuad(source, i) * factor + kAddend);
}
