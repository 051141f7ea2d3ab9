// Steps through a linear congruential generator `steps` times: work that takes as long as one likes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(push_constant) uniform Params { uint steps; };
COUNTERS(0, state);

void main() {
    uint x = state[gl_GlobalInvocationID.x];
    for (uint i = 0; i < steps; ++i) x = x * 1664525u + 1013904223u;
    state[gl_GlobalInvocationID.x] = x;
}
