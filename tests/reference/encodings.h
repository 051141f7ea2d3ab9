// Encodings of network inputs in double precision: frequency (Mildenhall et al. 2020, eq. 4), triangle wave
// and one-blob (Müller et al. 2019, 2021), real spherical harmonics. Grids of features: feature_grid.h.
#pragma once

#include "tests/reference/math.h"
#include <cstddef>
#include <vector>

namespace irradia::reference {

using Values = std::vector<double>;

Values identity(const Values& x, double scale = 1.0, double offset = 0.0); // scale x + offset

// Per input: sin(pi x), cos(pi x), sin(2 pi x), cos(2 pi x), ... sin and cos(2^(frequencies - 1) pi x).
Values frequency(const Values& x, int frequencies);

// 2 |x mod 2 - 1| - 1, the modulus in [0, 2): 1 at even x, -1 at odd x.
double triangle(double x);
Values triangleWave(const Values& x, int frequencies); // per input: triangle(2^k x), k < frequencies

// Mass of a kernel of width 1 / bins about x in each of `bins` equal bins of [0, 1]; what lies outside is
// lost.
Values oneBlobGaussian(double x, int bins); // sigma = 1 / bins
Values oneBlobQuartic(double x, int bins);  // 15/16 (1 - u^2)^2 over |u| <= 1, of radius 1 / bins
Values oneBlob(const Values& x, int bins, bool gaussian);

// Real orthonormal harmonics of a unit direction, bands 0 to degree - 1, ordered by (l, m), m = -l to l, with
// the Condon-Shortley phase: Y(1,-1) = -0.4886 y, Y(1,0) = 0.4886 z, Y(1,1) = -0.4886 x (Sloan 2013, appendix
// A2).
Values sphericalHarmonics(const Vec3& direction, int degree);

// First value of each part, which begins at a multiple of 4.
std::vector<std::size_t> partOffsets(const std::vector<std::size_t>& widths);
// The parts at their offsets, everything else 1, up to a multiple of 16.
Values composite(const std::vector<Values>& parts);

} // namespace irradia::reference
