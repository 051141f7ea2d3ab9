// Reads records, words, halves and counters at one index; the 7 shows that it ran.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(push_constant) uniform Params { uint index; };
QUADS_READ(0, records);
WORDS_READ(1, words);
HALVES_READ(2, halves);
COUNTERS_READ(3, counters);
QUADS_WRITE(4, results);

void main() {
    if (gl_GlobalInvocationID.x != 0) return;
    storeQuad(results, 0, loadQuad(records, index));
    storeQuad(results, 1, uvec4(loadWord(words, index), counters[index], 0, 7));
    storeQuad(results, 2, floatBitsToUint(loadHalves(halves, index)));
}
