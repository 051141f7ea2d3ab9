// The reference's encodings, put together as a model's parts say.
//
// Features: grid after grid, level after level, each level a multiple of 8 entries and each grid one of 16
// features. A level of R cells an edge has R + 1 corners an edge; in a HashGrid it has R and shares those
// beyond, or where R^dims entries do not fit the hash table, it is that table.
#pragma once

#include "nrc/learning/config.h"
#include "tests/reference/encodings.h"
#include "tests/reference/feature_grid.h"
#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace irradia::test {

class EncodingTwin {
public:
    struct Part {
        EncodingConfig config; // dims is resolved
        size_t firstInput = 0;
        size_t firstValue = 0, values = 0;
        std::optional<reference::FeatureGrid> grid{};
    };

    EncodingTwin(const std::vector<EncodingConfig>& parts, uint32_t inputs,
                 std::span<const glm::vec3> touched);

    const std::vector<Part>& parts() const { return parts_; }
    size_t width() const { return width_; }
    size_t featureCount() const { return features_; }
    double finestScale() const; // of the grids, 0 without

    // Of one row.
    std::vector<double> encode(const std::vector<double>& x, const std::vector<double>& features) const;
    void addGradient(const std::vector<double>& x, const std::vector<double>& encodedGradient,
                     std::vector<double>& featureGradient) const;

private:
    reference::FeatureGrid makeGrid(const EncodingConfig& config, std::span<const glm::vec3> touched);

    std::vector<Part> parts_;
    size_t width_ = 0;
    size_t features_ = 0;
};

} // namespace irradia::test
