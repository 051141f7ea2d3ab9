#include "tests/support/encoding_twin.h"

#include <algorithm>
#include <cmath>

namespace irradia::test {

namespace {

using reference::Values;

size_t roundUp(size_t n, size_t multiple) {
    return (n + multiple - 1) / multiple * multiple;
}

Values part(const Values& values, size_t first, size_t count) {
    const auto begin = values.begin() + static_cast<ptrdiff_t>(first);
    return {begin, begin + static_cast<ptrdiff_t>(count)};
}

Values inputsOf(const EncodingTwin::Part& made, const Values& x) {
    return part(x, made.firstInput, made.config.dims);
}

Values valuesOf(const EncodingTwin::Part& made, const Values& x, const Values& features) {
    const EncodingConfig& c = made.config;
    const auto whole = [&](const char* key) { return static_cast<int>(c.whole(key)); };
    if (c.otype == "Empty") return {};
    if (c.otype == "Identity") return reference::identity(x, c.number("scale"), c.number("offset"));
    if (c.otype == "Frequency") return reference::frequency(x, whole("n_frequencies"));
    if (c.otype == "TriangleWave") return reference::triangleWave(x, whole("n_frequencies"));
    if (c.otype == "OneBlob") return reference::oneBlob(x, whole("n_bins"), whole("kernel") == 1);
    if (c.otype == "SphericalHarmonics")
        return reference::sphericalHarmonics({x[0], x[1], x[2]}, whole("degree"));
    return made.grid->encode(x, features);
}

std::vector<Values> asValues(std::span<const glm::vec3> points, size_t dims) {
    std::vector<Values> values;
    for (const glm::vec3& p : points) values.push_back(part({p.x, p.y, p.z}, 0, dims));
    return values;
}

// Of a level whose table is not a list of corners.
uint64_t tableSize(const EncodingConfig& c, uint32_t cornersOnEdge) {
    const auto corners = static_cast<uint64_t>(std::pow(cornersOnEdge, c.dims));
    const uint64_t most = c.otype == "HashGrid" ? uint64_t{1} << c.whole("log2_hashmap_size") : UINT64_MAX;
    return corners > most ? most : roundUp(corners, 8);
}

} // namespace

reference::FeatureGrid EncodingTwin::makeGrid(const EncodingConfig& c, std::span<const glm::vec3> touched) {
    reference::FeatureGrid grid;
    grid.featuresPerLevel = c.whole("n_features_per_level");
    grid.mean = c.whole("aggregation") == 1;
    uint64_t next = features_ / grid.featuresPerLevel;
    for (uint32_t l = 0; l < c.whole("n_levels"); ++l) {
        reference::GridLevel level = reference::gridLevel(static_cast<int>(l), c.whole("base_resolution"),
                                                          c.number("per_level_scale"));
        level.firstEntry = next;
        if (c.otype == "SparseGrid") {
            const std::vector<Values> points = asValues(touched, c.dims);
            level.entry = reference::touchedEntry(level, points);
            next += roundUp(reference::touchedCount(level, points), 8);
        } else {
            const uint32_t onEdge = level.resolution + (c.otype == "DenseGrid" ? 1 : 0);
            level.entry = reference::tableEntry(onEdge, c.dims, tableSize(c, onEdge));
            next += tableSize(c, onEdge);
        }
        grid.levels.push_back(level);
    }
    features_ = roundUp(next * grid.featuresPerLevel, 16);
    return grid;
}

EncodingTwin::EncodingTwin(const std::vector<EncodingConfig>& parts, uint32_t inputs,
                           std::span<const glm::vec3> touched) {
    size_t taken = 0;
    for (const EncodingConfig& config : parts) taken += config.dims;
    std::vector<size_t> widths;
    for (const EncodingConfig& config : parts) {
        Part made{config, 0, 0, 0};
        if (config.dims == 0) made.config.dims = inputs - static_cast<uint32_t>(taken);
        if (!parts_.empty()) made.firstInput = parts_.back().firstInput + parts_.back().config.dims;
        if (config.otype.ends_with("Grid")) made.grid = makeGrid(made.config, touched);
        made.values =
            made.grid ? made.grid->width() : valuesOf(made, Values(made.config.dims, 0.0), {}).size();
        widths.push_back(made.values);
        parts_.push_back(std::move(made));
    }
    const std::vector<size_t> offsets = reference::partOffsets(widths);
    for (size_t p = 0; p < parts_.size(); ++p) parts_[p].firstValue = offsets[p];
    width_ = roundUp(offsets.back() + widths.back(), 16);
}

double EncodingTwin::finestScale() const {
    double finest = 0.0;
    for (const Part& made : parts_)
        if (made.grid) finest = std::max(finest, made.grid->levels.back().scale);
    return finest;
}

Values EncodingTwin::encode(const Values& x, const Values& features) const {
    std::vector<Values> values;
    for (const Part& made : parts_) values.push_back(valuesOf(made, inputsOf(made, x), features));
    return reference::composite(values);
}

void EncodingTwin::addGradient(const Values& x, const Values& encodedGradient,
                               Values& featureGradient) const {
    for (const Part& made : parts_)
        if (made.grid)
            made.grid->addGradient(inputsOf(made, x), part(encodedGradient, made.firstValue, made.values),
                                   featureGradient);
}

} // namespace irradia::test
