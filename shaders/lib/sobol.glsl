// Owen-scrambled Sobol' points in four dimensions, each made alone from its number and a key: Burley 2020, "Practical
// Hash-based Owen Scrambling"; directions of Joe and Kuo 2008; Owen's scrambling (1995) by the hash of Laine and Karras 2011
// with Vegdahl's constants (2021, "Building a Better LK Hash").
// No tables: about 130 operations beside the key's. Numbers are of kSobolBits bits; what lies above belongs in the key.
#ifndef IRRADIA_SOBOL_GLSL
#define IRRADIA_SOBOL_GLSL

const uint kSobolBits = 16u;

// A nested scramble of numbers whose bits are reversed: whether a bit is flipped depends on the lower bits alone.
uint scrambleReversed(uint x, uint key) {
    x ^= x * 0x3d20adeau;
    x += key;
    x *= (key >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

// The same of four, each by its key.
uvec4 scrambleReversed(uvec4 x, uvec4 key) {
    x ^= x * 0x3d20adeau;
    x += key;
    x *= (key >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

// Digit j of the second dimension is the sum of all digits k of which j is a subset, as bits go: Pascal's triangle modulo 2.
uint pascal(uint n) {
    n ^= (n >> 8u) & 0x00ffu;
    n ^= (n >> 4u) & 0x0f0fu;
    n ^= (n >> 2u) & 0x3333u;
    return n ^ ((n >> 1u) & 0x5555u);
}

uint column(uint n, uint k, uint digits) { return (n & (1u << k)) != 0u ? digits : 0u; }

// Of the third dimension in the lower half, of the fourth in the upper: primitive polynomials x^2 + x + 1, first directions
// 1 and 3, and x^3 + x + 1, first directions 1, 3 and 1.
uint thirdAndFourth(uint n) {
    uint d = column(n, 0u, 0x00010001u) ^ column(n, 1u, 0x00030003u) ^ column(n, 2u, 0x00040006u) ^ column(n, 3u, 0x000a0009u);
    d ^= column(n, 4u, 0x001f0017u) ^ column(n, 5u, 0x002e003au) ^ column(n, 6u, 0x00450071u) ^ column(n, 7u, 0x00c900a3u);
    d ^= column(n, 8u, 0x011b0116u) ^ column(n, 9u, 0x02a40339u) ^ column(n, 10u, 0x079a0677u) ^ column(n, 11u, 0x0b6709aau);
    return d ^ column(n, 12u, 0x101e1601u) ^ column(n, 13u, 0x302d3903u) ^ column(n, 14u, 0x40417706u) ^ column(n, 15u, 0xa0c3aa09u);
}

// Point `number` of the sequence that the key stands for, 32 bits of each coordinate. First digits are in the lowest bits
// until the last step. The order of the points is shuffled by a nested scramble too, so that sequences of different keys may
// be combined.
uvec4 sobolBits(uint number, uvec4 key) {
    uint reversed = bitfieldReverse(number) >> (32u - kSobolBits);
    uint shuffled = scrambleReversed(reversed, (key.x ^ key.z) * 0x9e3779b9u);
    uint n = bitfieldReverse(shuffled) >> (32u - kSobolBits);
    uint others = thirdAndFourth(n);
    return bitfieldReverse(scrambleReversed(uvec4(n, pascal(n), others & 0xffffu, others >> kSobolBits), key));
}

const uint kTileMask = 15u; // of a pixel's coordinates, in tiles of 16 x 16

// Number of a tile's pixel in z-order: bits of x and y in turn.
uint zOrder(uvec2 pixel) {
    uint z = pixel.x | pixel.y << 16u;
    z = (z | z << 2u) & 0x00330033u;
    z = (z | z << 1u) & 0x00550055u;
    return (z | z >> 15u) & 0xffu;
}

// What a tile's pixel shifts its points by: point zOrder(pixel) of the sequence that the key stands for.
uvec4 tileShift(uvec2 pixel, uvec4 key) { return sobolBits(zOrder(pixel), key); }

#endif
