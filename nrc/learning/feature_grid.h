// The levels of a grid of features: where corners lie, and which entry of the tables each has.
#pragma once

#include "engine/gpu/device.h"
#include "nrc/learning/encoding_layout.h"
#include "shared/network.h"
#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace irradia {

struct FeatureGrid {
    uint32_t kind = gpu::kGridDense;
    std::vector<gpu::GridLevel> levels;
    std::vector<uint32_t> entries; // of a sparse grid: level after level, the entry of each corner
    uint64_t end = 0;              // the first entry behind the grid
};

// A grid whose entries begin at `first`, level after level, each padded to a multiple of 8 entries. Levels of
// a DenseGrid and a SparseGrid have a corner more an edge than tiny-cuda-nn's, which lets features of
// opposite faces of the cube be the same. Throws Error(BadData) where the configuration has no such grid,
// Error(OutOfMemory) with the numbers where it outgrows a binding.
FeatureGrid makeFeatureGrid(const EncodingConfig& config, uint64_t first,
                            const VkPhysicalDeviceLimits& limits, std::span<const glm::vec3> touched);

// The grids of an encoding, one after the other.
struct FeatureGrids {
    std::vector<FeatureGrid> grids;        // of the layout's slices that are grids
    uint64_t features = 0;                 // of all
    std::optional<uint32_t> storedCorners; // CRC-32 of which corners the sparse ones store
};

FeatureGrids layOutGrids(const EncodingLayout& layout, const VkPhysicalDeviceLimits& limits,
                         std::span<const glm::vec3> touched);

// Throws Error(OutOfMemory) where so many features, each with 8 bytes of gradient sums, outgrow a binding.
void requireBindable(uint64_t features, const std::string& what, const VkPhysicalDeviceLimits& limits);

} // namespace irradia
