// Owen-scrambled Sobol' points in four dimensions, step by step as the papers have them.
#pragma once

#include <array>
#include <cstdint>

namespace irradia::reference {

using Words = std::array<uint32_t, 4>;

// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
Words pcg4d(Words v);

// Coordinate of point `number` of the Sobol' sequence as a binary fraction: the sum of the directions of the
// number's digits (Sobol' 1967; primitive polynomials and first directions of Joe and Kuo 2008).
uint32_t sobol(uint32_t number, int dimension);

// Owen's scrambling (1995) of a binary fraction: each digit is flipped or not as the key and the digits
// before it say. By the hash of Laine and Karras 2011, with Vegdahl's constants (2021), as Burley 2020 does.
uint32_t nestedScramble(uint32_t fraction, uint32_t key);

struct SobolKeys {
    Words values;
    uint32_t order;
};

SobolKeys sobolKeys(const Words& values);

// The point in place `number` of 65,536 of a shuffled and scrambled sequence (Burley 2020, listing 4).
Words shuffledScrambledSobol(uint32_t number, const SobolKeys& keys);

struct PixelKeys {
    SobolKeys sequence; // of the tile
    SobolKeys shift;    // of the pixels' shifts
    uint32_t place;     // of the pixel in its tile, in z-order (Morton 1966)
};

// Of a block of a pixel's decisions; `group` is the sample's number without its last 16 bits.
PixelKeys pixelKeys(uint32_t pixel, uint32_t width, uint32_t group, uint32_t block, uint32_t seed);

// The point in place `number` of 65,536 of the pixel: the tile's, digits shifted.
Words pixelPoint(uint32_t number, const PixelKeys& keys);

} // namespace irradia::reference
