// Encodings of network inputs: frequency (Mildenhall et al. 2020, eq. 4), triangle wave and one-blob (Müller et al. 2019,
// 2021), spherical harmonics, and the spatial hash of feature grids (Müller et al. 2022).
#ifndef IRRADIA_ENCODING_GLSL
#define IRRADIA_ENCODING_GLSL

// 2 |x mod 2 - 1| - 1 of x = 2 h: 1 at even x, -1 at odd x. Exact but for the last subtraction.
float triangleOfHalf(float h) { return abs(4.0 * fract(h) - 2.0) - 1.0; }
float triangleWave(float x) { return triangleOfHalf(0.5 * x); }

// sin(pi/2 x) for |x| <= 1: minimax polynomial, off by at most 3.4e-9 before rounding. (Vulkan lets its own sin be off by
// 2^-11, and only inside [-pi, pi].)
float sinQuarters(float x) {
    float s = x * x;
    return x * (1.57079629 + s * (-0.64596336 + s * (0.079688481 + s * (-0.0046722279 + s * 1.5082056e-4))));
}

// A quarter of the period is taken off within it: from a large negative x it would be rounded off in part.
float sinPi(float x) { return sinQuarters(triangleOfHalf(fract(0.5 * x) - 0.25)); }
float cosPi(float x) { return sinQuarters(triangleWave(x)); }

// Distribution functions of the one-blob kernels, of the distance in kernel widths.
float quarticCdf(float u) {
    u = clamp(u, -1.0, 1.0);
    float s = u * u;
    return 0.5 + u * (0.9375 + s * (-0.625 + s * 0.1875)); // integral of 15/16 (1 - u^2)^2
}

float gaussianCdf(float u) { // by erf of Abramowitz and Stegun 1964, 7.1.28: off by at most 3e-7 before rounding
    float x = min(abs(u), 6.0) * 0.70710678;
    float p = 1.0 + x * (0.0705230784 + x * (0.0422820123 + x * (0.0092705272 +
              x * (0.0001520143 + x * (0.0002765672 + x * 0.0000430638)))));
    p *= p;
    p *= p;
    p *= p;
    float tail = 0.5 / (p * p);
    return u < 0.0 ? tail : 1.0 - tail;
}

// Real orthonormal harmonics of a unit direction, bands 0 to 3, ordered by (l, m), m = -l to l, with the Condon-Shortley
// phase (Sloan 2013, "Efficient Spherical Harmonic Evaluation", appendix A2).
void sphericalHarmonics(vec3 d, out float y[16]) {
    float x2 = d.x * d.x, y2 = d.y * d.y, z2 = d.z * d.z;
    y[0] = 0.28209479;
    y[1] = -0.48860251 * d.y;
    y[2] = 0.48860251 * d.z;
    y[3] = -0.48860251 * d.x;
    y[4] = 1.0925484 * d.x * d.y;
    y[5] = -1.0925484 * d.y * d.z;
    y[6] = 0.94617470 * z2 - 0.31539157;
    y[7] = -1.0925484 * d.x * d.z;
    y[8] = 0.54627422 * (x2 - y2);
    y[9] = 0.59004359 * d.y * (y2 - 3.0 * x2);
    y[10] = 2.8906114 * d.x * d.y * d.z;
    y[11] = 0.45704580 * d.y * (1.0 - 5.0 * z2);
    y[12] = 0.37317633 * d.z * (5.0 * z2 - 3.0);
    y[13] = 0.45704580 * d.x * (1.0 - 5.0 * z2);
    y[14] = 1.4453057 * d.z * (x2 - y2);
    y[15] = 0.59004359 * d.x * (3.0 * y2 - x2);
}

// Müller et al. 2022, eq. 4.
uint spatialHash(uvec3 corner) { return corner.x ^ corner.y * 2654435761u ^ corner.z * 805459861u; }

#endif
