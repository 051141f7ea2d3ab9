// What a trainer is made for, beside its model.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace irradia {

struct TrainerOptions {
    uint32_t batchRows = 1u << 14;  // records of a step at most; rounded up to gpu::kRowPadding
    uint32_t inferRows = 1u << 14;  // rows predicted together at most, likewise; more are predicted in parts
    uint64_t seed = 1;              // of the initial parameters and of the shuffling
    std::vector<glm::vec3> touched; // for a SparseGrid
};

} // namespace irradia
