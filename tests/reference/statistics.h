// Distribution functions and hypothesis tests.
#pragma once

#include <cstddef>
#include <vector>

namespace irradia::reference {

// Regularised upper incomplete gamma function Q(a, x), a > 0, x >= 0 (DLMF 8.2.4; series 8.7.1 below a + 1,
// continued fraction 8.9.2 above).
double upperGamma(double a, double x);

// Two-sided p-value of a standard normal deviate: erfc(|z| / sqrt 2) (DLMF 7.18, 26.2.17).
double normalTwoSided(double z);

// Level of each of `count` independent tests so that all pass by chance with 1 - alpha: 1 - (1 - alpha)^(1 /
// count) (Sidak 1967).
double sidakLevel(double alpha, std::size_t count);

struct ChiSquareResult {
    double statistic = 0.0;
    int degreesOfFreedom = 0;
    double pValue =
        1.0; // chance of so large a statistic if the hypothesis holds; 0 if an impossible bin was hit
};

// Pearson's test of observed counts against expected ones that were fixed beforehand (nothing is fitted or
// rescaled: a density that does not integrate to 1 fails). Bins expected below minExpected are merged,
// smallest first, until they reach it (Cochran 1954 asks for 5). Degrees of freedom = merged bins - 1.
ChiSquareResult chiSquareTest(const std::vector<double>& observed, const std::vector<double>& expected,
                              double minExpected = 5.0);

} // namespace irradia::reference
