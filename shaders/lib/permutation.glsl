// A permutation of 0 .. count - 1 for each key, evaluated at one place: a Feistel network over the smallest power of 4
// that holds count (Luby and Rackoff 1988), walked until it lands inside (Black and Rogaway 2002): 4 steps at most are
// expected, and 0 < count <= 2^30.
#ifndef IRRADIA_PERMUTATION_GLSL
#define IRRADIA_PERMUTATION_GLSL

const uint kFeistelRounds = 4u;

// A mix of 32 bits in which each bit of x changes half of the result's (constants: Wellons 2018, lowbias32).
uint mixBits(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

uint feistel(uint index, uint halfBits, uint key) {
    uint mask = (1u << halfBits) - 1u;
    uint left = index >> halfBits, right = index & mask;
    for (uint round = 0u; round < kFeistelRounds; ++round) {
        uint next = left ^ (mixBits(right ^ mixBits(key + round)) & mask);
        left = right;
        right = next;
    }
    return (left << halfBits) | right;
}

uint permute(uint index, uint count, uint key) {
    uint halfBits = max((uint(findMSB(max(count, 2u) - 1u)) + 2u) / 2u, 1u);
    do {
        index = feistel(index, halfBits, key);
    } while (index >= count);
    return index;
}

#endif
