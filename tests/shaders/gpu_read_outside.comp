// Reads records, words, halves and counters at one index; the 7 shows that it ran.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(push_constant) uniform Params { uint index; };
RECORDS_READ(0, records);
WORDS_READ(1, words);
HALVES_READ(2, halves);
COUNTERS_READ(3, counters);
RECORDS_WRITE(4, results);

void main() {
    if (gl_GlobalInvocationID.x != 0) return;
    storeRecord(results, 0, loadRecord(records, index));
    storeRecord(results, 1, uvec4(loadWord(words, index), counters[index], 0, 7));
    storeRecord(results, 2, floatBitsToUint(loadHalves(halves, index)));
}
