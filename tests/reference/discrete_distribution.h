// Sampling of an index in proportion to weights, by inversion of the cumulative sum.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace irradia::reference {

class DiscreteDistribution {
public:
    explicit DiscreteDistribution(const std::vector<double>& weights = {})
        : cumulative_{0.0} {
        for (const double weight : weights) cumulative_.push_back(cumulative_.back() + weight);
    }

    double total() const { return cumulative_.back(); }
    double probability(std::size_t i) const { return (cumulative_[i + 1] - cumulative_[i]) / total(); }

    // The index for u in [0, 1) and where u lies within its interval, again uniform in [0, 1). total() must
    // not be 0.
    std::pair<std::size_t, double> sample(double u) const {
        const double target = u * total();
        const auto above = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, target);
        const auto i = static_cast<std::size_t>(above - cumulative_.begin()) - 1;
        const double width = cumulative_[i + 1] - cumulative_[i];
        return {i, std::clamp((target - cumulative_[i]) / width, 0.0, 0x1.fffffffffffffp-1)};
    }

private:
    std::vector<double> cumulative_; // n + 1 sums, the first 0
};

} // namespace irradia::reference
