#include "tests/reference/feature_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace irradia::reference {

GridLevel gridLevel(int level, uint32_t base, double perLevelScale) {
    GridLevel made;
    made.scale = base * std::pow(perLevelScale, level) - 1.0;
    made.resolution = static_cast<uint32_t>(std::ceil(made.scale)) + 1;
    return made;
}

CornerEntry tableEntry(uint32_t resolution, std::size_t dims, uint64_t tableSize) {
    const bool dense = std::pow(resolution, dims) <= static_cast<double>(tableSize);
    return [=](const Corner& corner) -> std::optional<uint64_t> {
        constexpr std::array<uint32_t, 3> kPrimes{1, 2654435761, 805459861};
        uint64_t index = 0, stride = 1;
        uint32_t hash = 0;
        for (std::size_t d = 0; d < dims; ++d, stride *= resolution) {
            index += corner[d] * stride;
            hash ^= corner[d] * kPrimes.at(d);
        }
        return (dense ? index : hash) % tableSize;
    };
}

namespace {

// The last coordinate counts most.
struct ByReversed {
    bool operator()(const Corner& a, const Corner& b) const {
        return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
    }
};

std::set<Corner, ByReversed> touchedCorners(const GridLevel& level,
                                            const std::vector<std::vector<double>>& points) {
    std::set<Corner, ByReversed> corners;
    for (const std::vector<double>& x : points)
        for (std::size_t which = 0; which < std::size_t{1} << x.size(); ++which) {
            Corner corner;
            for (std::size_t d = 0; d < x.size(); ++d)
                corner.push_back(
                    static_cast<uint32_t>(std::floor(std::clamp(x[d], 0.0, 1.0) * level.scale + 0.5)) +
                    (which >> d & 1));
            corners.insert(corner);
        }
    return corners;
}

} // namespace

CornerEntry touchedEntry(const GridLevel& level, const std::vector<std::vector<double>>& points) {
    std::map<Corner, uint64_t> entries;
    uint64_t next = 0;
    for (const Corner& corner : touchedCorners(level, points)) entries[corner] = next++;
    return [entries](const Corner& corner) -> std::optional<uint64_t> {
        const auto found = entries.find(corner);
        return found == entries.end() ? std::nullopt : std::optional(found->second);
    };
}

uint64_t touchedCount(const GridLevel& level, const std::vector<std::vector<double>>& points) {
    return touchedCorners(level, points).size();
}

std::vector<GridCorner> cornersAbout(const GridLevel& level, const std::vector<double>& x) {
    std::vector<GridCorner> corners;
    for (std::size_t which = 0; which < std::size_t{1} << x.size(); ++which) {
        Corner corner;
        double weight = 1.0;
        for (std::size_t d = 0; d < x.size(); ++d) {
            const double p = std::clamp(x[d], 0.0, 1.0) * level.scale + 0.5, cell = std::floor(p);
            const bool upper = (which >> d & 1) != 0;
            corner.push_back(static_cast<uint32_t>(cell) + (upper ? 1 : 0));
            weight *= upper ? p - cell : 1.0 - (p - cell);
        }
        if (const auto entry = level.entry(corner)) corners.push_back({level.firstEntry + *entry, weight});
    }
    return corners;
}

template <typename Visit>
void FeatureGrid::forEach(const std::vector<double>& x, Visit&& visit) const {
    const double share = mean ? 1.0 / static_cast<double>(levels.size()) : 1.0;
    for (std::size_t l = 0; l < levels.size(); ++l)
        for (const GridCorner& corner : cornersAbout(levels[l], x))
            for (std::size_t f = 0; f < featuresPerLevel; ++f)
                visit((mean ? 0 : l * featuresPerLevel) + f, corner.entry * featuresPerLevel + f,
                      share * corner.weight);
}

std::vector<double> FeatureGrid::encode(const std::vector<double>& x,
                                        const std::vector<double>& features) const {
    std::vector<double> values(width(), 0.0);
    forEach(x, [&](std::size_t value, std::size_t feature, double weight) {
        values[value] += weight * features.at(feature);
    });
    return values;
}

void FeatureGrid::addGradient(const std::vector<double>& x, const std::vector<double>& encodedGradient,
                              std::vector<double>& featureGradient) const {
    forEach(x, [&](std::size_t value, std::size_t feature, double weight) {
        featureGradient.at(feature) += weight * encodedGradient[value];
    });
}

} // namespace irradia::reference
