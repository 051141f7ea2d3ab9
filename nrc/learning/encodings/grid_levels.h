// The levels of a grid of features: where corners lie, and which entry of the tables each has.
#pragma once

#include "nrc/learning/encodings/slice.h"
#include "shared/network.h"

namespace irradia {

// A grid as its keys describe it.
struct GridConfig {
    uint32_t kind = gpu::kGridDense;
    uint32_t dims = 3;
    uint32_t levels = 8;
    uint32_t featuresPerLevel = 2;
    uint32_t log2HashmapSize = 15; // of a hash grid
    uint32_t baseResolution = 16;
    double perLevelScale = 2.0;
};

struct FeatureGrid {
    std::vector<gpu::GridLevel> levels;
    std::vector<uint32_t> entries; // of a sparse grid: level after level, the entry of each corner
    uint64_t end = 0;              // the first entry behind the grid
};

// A grid whose entries begin at room.first / featuresPerLevel, level after level, each padded to a multiple
// of 8 entries. Levels of a DenseGrid and a SparseGrid have a corner more an edge than tiny-cuda-nn's, which
// lets features of opposite faces of the cube be the same. Throws Error(BadData) where the configuration has
// no such grid, Error(OutOfMemory) with the numbers where it outgrows a binding.
FeatureGrid makeFeatureGrid(const GridConfig& config, const FeatureRoom& room);

} // namespace irradia
