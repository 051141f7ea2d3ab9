#include "tests/support/encoding_comparison.h"

#include <algorithm>
#include <cmath>

namespace irradia::test {

namespace {

constexpr double kUlp = 0x1p-23; // of 1 in single precision

// How far single precision may be from the exact value.
double allowance(const EncodingTwin::Part& part, double finestScale) {
    const EncodingConfig& c = part.config;
    if (c.otype == "Empty") return 0.0;
    if (c.otype == "Identity") return 2.0 * kUlp; // a product and a sum of numbers below 4
    // Of numbers below 2 before the sine, whose slope is pi / 2, and in its sum.
    if (c.otype == "Frequency") return 4.0 * kUlp;
    if (c.otype == "TriangleWave") return 2.0 * kUlp; // of numbers below 2, of which one may be negative
    if (c.otype == "OneBlob") // x bins, whose error changes the mass by less; a sixteenth power, twice
        return (c.whole("kernel") == 1 ? 16.0 : 2.0) * kUlp + 0.625 * c.number("n_bins") * kUlp;
    // Polynomials of five roundings, with coefficients below 3.
    if (c.otype == "SphericalHarmonics") return 8.0 * kUlp;
    // x scale and the scale are rounded; features of -1 to 1 differ by 2 in each direction.
    return (2.0 * c.dims * finestScale + 8.0) * kUlp;
}

// Of each value of a row; 0 between the parts.
std::vector<double> allowances(const EncodingTwin& twin) {
    std::vector<double> allowed(twin.width(), 0.0);
    for (const EncodingTwin::Part& part : twin.parts())
        std::fill_n(allowed.begin() + static_cast<ptrdiff_t>(part.firstValue), part.values,
                    allowance(part, twin.finestScale()));
    return allowed;
}

std::vector<double> rowOf(const std::vector<double>& values, size_t row, size_t width) {
    const auto first = values.begin() + static_cast<ptrdiff_t>(row * width);
    return {first, first + static_cast<ptrdiff_t>(width)};
}

double shareOf(double allowed, double error) {
    if (error == 0.0) return 0.0;
    return std::isnan(error) || allowed == 0.0 ? INFINITY : error / allowed;
}

} // namespace

double encodingError(const EncodingHarness& harness, const EncodingBatch& batch,
                     const std::vector<double>& features, const std::vector<double>& encoded) {
    const EncodingTwin& twin = harness.twin();
    const size_t width = twin.width();
    if (encoded.size() != batch.count * width) return INFINITY;
    const std::vector<double> single = allowances(twin);
    double worst = 0.0;
    for (size_t row = 0; row < batch.count; ++row) {
        const auto expected = twin.encode(rowOf(batch.inputs, row, harness.encoding().inputs()), features);
        for (size_t v = 0; v < width; ++v) {
            double allowed = single[v];
            if (harness.precision() == Precision::Half && allowed > 0.0) // rounded to the nearest
                allowed += std::max(0x1p-11 * std::abs(expected[v]), 0x1p-25);
            worst = std::max(worst, shareOf(allowed, std::abs(encoded[row * width + v] - expected[v])));
        }
    }
    return worst;
}

std::vector<double> twinGradient(const EncodingHarness& harness, const EncodingBatch& batch) {
    const EncodingTwin& twin = harness.twin();
    std::vector<double> gradient(twin.featureCount(), 0.0);
    for (size_t row = 0; row < batch.count; ++row)
        twin.addGradient(rowOf(batch.inputs, row, harness.encoding().inputs()),
                         rowOf(batch.encodedGradient, row, twin.width()), gradient);
    return gradient;
}

double largestDifference(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) return INFINITY;
    double worst = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        const double difference = std::abs(a[i] - b[i]);
        worst = std::max(worst, std::isnan(difference) ? INFINITY : difference);
    }
    return worst;
}

} // namespace irradia::test
