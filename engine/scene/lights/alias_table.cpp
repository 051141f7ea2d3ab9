#include "engine/scene/lights/alias_table.h"

#include <numeric>

namespace irradia {

std::vector<AliasEntry> buildAliasTable(std::span<const double> weights) {
    const size_t count = weights.size();
    std::vector<AliasEntry> table(count);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<double> scaled(count); // mass * count: 1 on average
    std::vector<uint32_t> small, large;
    for (size_t i = 0; i < count; ++i) {
        table[i].mass = sum > 0.0 ? weights[i] / sum : 1.0 / static_cast<double>(count);
        table[i].alias = static_cast<uint32_t>(i);
        scaled[i] = table[i].mass * static_cast<double>(count);
        (scaled[i] < 1.0 ? small : large).push_back(static_cast<uint32_t>(i));
    }
    while (!small.empty() && !large.empty()) {
        const uint32_t under = small.back();
        const uint32_t over = large.back();
        small.pop_back();
        table[under].keep = static_cast<float>(scaled[under]);
        table[under].alias = over;
        scaled[over] -= 1.0 - scaled[under];
        if (scaled[over] < 1.0) {
            large.pop_back();
            small.push_back(over);
        }
    }
    // What is left over is 1 up to rounding, unless it has no mass at all.
    for (const uint32_t i : small) table[i].keep = scaled[i] > 0.0 ? 1.0f : 0.0f;
    for (const uint32_t i : large) table[i].keep = 1.0f;
    return table;
}

} // namespace irradia
