// Multiresolution grids of trainable features in double precision: Müller et al. 2022, section 3 (hash
// tables, concatenated levels); Hadadan et al. 2021 (voxels that surfaces touch, mean over levels).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace irradia::reference {

using Corner = std::vector<uint32_t>; // integer coordinates, a value per dimension

// Which entry of a level's table belongs to a corner; none: the corner is absent and its features are zero.
using CornerEntry = std::function<std::optional<uint64_t>(const Corner&)>;

struct GridLevel {
    double scale = 0.0;      // x in [0, 1] lies at x scale + 1/2 in cells
    uint32_t resolution = 0; // corners per dimension of a dense table
    uint64_t firstEntry = 0; // of the level's table, in entries
    CornerEntry entry;       // within the table
};

// scale = base perLevelScale^level - 1, resolution = ceil(scale) + 1; entry and firstEntry remain to be set.
GridLevel gridLevel(int level, uint32_t base, double perLevelScale);

// x + y R + z R^2 where R^dims entries fit the table, else the hash x ^ 2654435761 y ^ 805459861 z (Müller et
// al. 2022, eq. 4, in 32 bits); both modulo the table, which the corner R of a dense level needs.
CornerEntry tableEntry(uint32_t resolution, std::size_t dims, uint64_t tableSize);

// The corners of the voxels that hold one of the points, and no others, numbered in the order of z, y, x
// (NGLOD, Takikawa et al. 2021, section 3.2). The points are clamped to [0, 1].
CornerEntry touchedEntry(const GridLevel& level, const std::vector<std::vector<double>>& points);
// How many there are.
uint64_t touchedCount(const GridLevel& level, const std::vector<std::vector<double>>& points);

struct GridCorner {
    uint64_t entry;
    double weight;
};

// The corners about x (clamped to [0, 1]) that are present, with their d-linear weights.
std::vector<GridCorner> cornersAbout(const GridLevel& level, const std::vector<double>& x);

struct FeatureGrid {
    std::vector<GridLevel> levels;
    std::size_t featuresPerLevel = 2; // consecutive in an entry
    bool mean = false;                // over levels; else the levels' values one after the other

    std::size_t width() const { return mean ? featuresPerLevel : featuresPerLevel * levels.size(); }
    std::vector<double> encode(const std::vector<double>& x, const std::vector<double>& features) const;
    // Adds the derivative of a scalar by the features, from that by the encoded values.
    void addGradient(const std::vector<double>& x, const std::vector<double>& encodedGradient,
                     std::vector<double>& featureGradient) const;

private:
    // Calls visit(value, feature, weight) for each feature that a value depends on.
    template <typename Visit>
    void forEach(const std::vector<double>& x, Visit&& visit) const;
};

} // namespace irradia::reference
