#version 460
#extension GL_GOOGLE_include_directive : require
// Choosing kept (y) of n (z) things: result record i holds, of thing k = x of input i, its place in x, and in y 1 if it is
// kept.
#include "lib/even_choice.glsl"
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, things);
QUADS_WRITE(1, results);
layout(push_constant) uniform Push { CountParams params; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    uvec4 thing = loadQuad(things, i);
    bool isKept = thing.x < thing.z && isEvenlyKept(thing.x, thing.y, thing.z);
    storeQuad(results, i, uvec4(evenPlace(thing.x, thing.y, thing.z), isKept ? 1u : 0u, 0u, 0u));
}
