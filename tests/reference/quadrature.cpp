#include "tests/reference/quadrature.h"
#include "tests/reference/math.h"
#include <map>
#include <utility>

namespace irradia::reference {

namespace {

// P_n(x) and its derivative by Bonnet's recursion (DLMF 18.9.1 and 18.9.17).
std::pair<double, double> legendre(int n, double x) {
    double previous = 1.0, current = x;
    for (int k = 2; k <= n; ++k) {
        const double next = ((2.0 * k - 1.0) * x * current - (k - 1.0) * previous) / k;
        previous = std::exchange(current, next);
    }
    return {current, n * (x * current - previous) / (x * x - 1.0)};
}

} // namespace

QuadratureRule gaussLegendre(int n) {
    if (n == 1) return {{0.5}, {1.0}};
    QuadratureRule rule;
    for (int i = 0; i < n; ++i) {
        double x = -std::cos(kPi * (i + 0.75) / (n + 0.5)); // Tricomi's first guess, then Newton
        for (int step = 0; step < 8; ++step) {
            const auto [value, slope] = legendre(n, x);
            x -= value / slope;
        }
        const double slope = legendre(n, x).second;
        rule.nodes.push_back(0.5 * (1.0 + x));
        rule.weights.push_back(1.0 / ((1.0 - x * x) * slope * slope)); // DLMF 3.5.22, halved for [0, 1]
    }
    return rule;
}

const QuadratureRule& keptRule(int n) {
    thread_local std::map<int, QuadratureRule> rules;
    auto found = rules.find(n);
    if (found == rules.end()) found = rules.emplace(n, gaussLegendre(n)).first;
    return found->second;
}

} // namespace irradia::reference
