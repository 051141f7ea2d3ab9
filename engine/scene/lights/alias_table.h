// Sampling proportional to weights in constant time: Walker's alias method in Vose's linear-time form (Vose
// 1991, "A Linear Algorithm for Generating Random Numbers with a Given Distribution").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace irradia {

struct AliasEntry {
    float keep = 1.0f;  // probability of keeping the uniformly chosen entry
    uint32_t alias = 0; // else this one is taken
    double mass = 0.0;  // probability of this entry overall; sums to 1
};

// Weights must be finite and >= 0. All zero gives the uniform distribution.
std::vector<AliasEntry> buildAliasTable(std::span<const double> weights);

} // namespace irradia
