#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace irradia::reference {

// Largest difference between `gradient` and central differences of `f` about x, relative to the largest
// derivative. With steps of 1e-5 the differences themselves err by about 1e-10 of the third derivatives and
// by 1e-16 / 1e-5 of f through rounding: kGradientTolerance is safe where these are of the gradient's order.
template <typename Function>
double gradientError(Function&& f, std::vector<double> x, const std::vector<double>& gradient) {
    constexpr double kStep = 1e-5;
    double worst = 0.0, largest = 1e-300;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double at = x[i];
        x[i] = at + kStep;
        const double above = f(x);
        x[i] = at - kStep;
        const double difference = (above - f(x)) / (2.0 * kStep);
        x[i] = at;
        worst = std::max(worst, std::abs(difference - gradient[i]));
        largest = std::max(largest, std::abs(difference));
    }
    return worst / largest;
}
constexpr double kGradientTolerance = 1e-7;

} // namespace irradia::reference
