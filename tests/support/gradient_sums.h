// Sums of gradients as the kernels keep them (shaders/shared/network.h), and as numbers.
#pragma once

#include "shared/network.h"
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace irradia::test {

// Low words, then high ones, of sums given in units of 1 / kGradientUnits times `scale`.
inline std::vector<int32_t> sumsOf(std::span<const float> gradients, double scale) {
    std::vector<int32_t> words(2 * gradients.size());
    for (size_t i = 0; i < gradients.size(); ++i) {
        const int64_t sum = std::llround(gradients[i] / scale * gpu::kGradientUnits);
        words[i] = static_cast<int32_t>(sum); // modulo 2^32
        words[gradients.size() + i] = static_cast<int32_t>((sum - words[i]) >> 32);
    }
    return words;
}

inline std::vector<double> gradientsOf(std::span<const int32_t> words) {
    std::vector<double> gradients(words.size() / 2);
    for (size_t i = 0; i < gradients.size(); ++i)
        gradients[i] = (4294967296.0 * words[gradients.size() + i] + words[i]) / gpu::kGradientUnits;
    return gradients;
}

} // namespace irradia::test
