#include "tests/reference/statistics.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace irradia::reference {

namespace {

constexpr int kMaxTerms = 100000;

// gamma(a, x) e^x x^-a = sum of x^n / (a (a + 1) ... (a + n)) (DLMF 8.7.1).
double lowerSeries(double a, double x) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < kMaxTerms && term > 1e-17 * sum; ++n) sum += term *= x / (a + n);
    return sum;
}

// Gamma(a, x) e^x x^-a by the continued fraction of DLMF 8.9.2 in its even part, with Lentz's method (1976).
double upperFraction(double a, double x) {
    double b = x + 1.0 - a, c = 1e300, d = 1.0 / b, product = d;
    for (int n = 1; n < kMaxTerms; ++n) {
        const double numerator = -n * (n - a);
        b += 2.0;
        d = 1.0 / (numerator * d + b);
        c = b + numerator / c;
        product *= c * d;
        if (std::abs(c * d - 1.0) < 1e-15) break;
    }
    return product;
}

} // namespace

double upperGamma(double a, double x) {
    if (x <= 0.0) return 1.0;
    const double factor = std::exp(a * std::log(x) - x - std::lgamma(a));
    return x < a + 1.0 ? 1.0 - factor * lowerSeries(a, x) : factor * upperFraction(a, x);
}

double normalTwoSided(double z) {
    return std::erfc(std::abs(z) * std::sqrt(0.5));
}

double sidakLevel(double alpha, std::size_t count) {
    return -std::expm1(std::log1p(-alpha) / static_cast<double>(count));
}

ChiSquareResult chiSquareTest(const std::vector<double>& observed, const std::vector<double>& expected,
                              double minExpected) {
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return expected[i] < expected[j]; });

    ChiSquareResult result;
    int bins = 0;
    double pooledObserved = 0.0, pooledExpected = 0.0;
    const auto close = [&] {
        const double difference = pooledObserved - pooledExpected;
        result.statistic += difference * difference / pooledExpected;
        pooledObserved = pooledExpected = 0.0;
        ++bins;
    };
    bool isImpossible = false;
    for (const std::size_t i : order) {
        isImpossible = isImpossible || !(expected[i] >= 0.0) || (expected[i] == 0.0 && observed[i] > 0.0);
        pooledObserved += observed[i];
        pooledExpected += expected[i];
        if (pooledExpected >= minExpected) close();
    }
    if (pooledExpected > 0.0) close(); // only where the whole histogram expects less than minExpected
    result.degreesOfFreedom = std::max(bins - 1, 1);
    result.pValue = isImpossible ? 0.0 : upperGamma(0.5 * result.degreesOfFreedom, 0.5 * result.statistic);
    return result;
}

} // namespace irradia::reference
