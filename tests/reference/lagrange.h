// Cubic Lagrange interpolation on a uniform grid.
#pragma once

#include <algorithm>
#include <array>

namespace irradia::reference {

// At x, in units of the grid's step, of values on n nodes: the first node and four weights.
struct Stencil {
    int first;
    std::array<double, 4> weight;

    Stencil(double x, int n)
        : first(std::clamp(static_cast<int>(x) - 1, 0, n - 4)) {
        const double t = x - first;
        weight = {(t - 1) * (t - 2) * (t - 3) / -6, t * (t - 2) * (t - 3) / 2, t * (t - 1) * (t - 3) / -2,
                  t * (t - 1) * (t - 2) / 6};
    }

    template <typename Values>
    double operator()(const Values& values) const {
        double sum = 0.0;
        for (int i = 0; i < 4; ++i) sum += weight[i] * values[first + i];
        return sum;
    }
};

} // namespace irradia::reference
