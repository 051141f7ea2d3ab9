// Gauss-Legendre quadrature.
#pragma once

#include <cstddef>
#include <vector>

namespace irradia::reference {

struct QuadratureRule {
    std::vector<double> nodes;   // in (0, 1), ascending
    std::vector<double> weights; // sum 1

    // Integral of f over [from, to].
    template <typename Function>
    auto integrate(double from, double to, Function&& f) const {
        auto sum = weights[0] * f(from + (to - from) * nodes[0]);
        for (std::size_t i = 1; i < nodes.size(); ++i) sum += weights[i] * f(from + (to - from) * nodes[i]);
        return (to - from) * sum;
    }
};

// The n-point rule on [0, 1], exact for polynomials of degree 2 n - 1.
QuadratureRule gaussLegendre(int n);

// The same, made once for a thread.
const QuadratureRule& keptRule(int n);

} // namespace irradia::reference
