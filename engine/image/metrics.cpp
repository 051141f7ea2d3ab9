#include "engine/image/metrics.h"

#include "engine/error.h"
#include "engine/image/display.h"
#include "engine/image/flip.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace irradia {
namespace {

// Keeps black reference pixels from dividing by nothing; the field's usual value.
constexpr double kEpsilon = 0.01;

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void checkSizes(int width, int height, std::span<const glm::vec3> test,
                std::span<const glm::vec3> reference) {
    const size_t pixels = size_t(width) * size_t(height);
    if (width <= 0 || height <= 0 || test.size() != pixels || reference.size() != pixels)
        fail(ExitCode::Internal, "comparing {} with {} pixels as {} x {}", test.size(), reference.size(),
             width, height);
}

// Equal means have ratio 1, black ones included.
double ratio(double test, double reference) {
    return test == reference ? 1.0 : test / reference;
}

double meanFlip(int width, int height, std::span<const glm::vec3> test,
                std::span<const glm::vec3> reference) {
    const auto errors = flipErrors(toDisplay(width, height, test), toDisplay(width, height, reference));
    return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

} // namespace

void checkReference(int width, std::span<const glm::vec3> reference) {
    const auto isBad = [](const glm::vec3& pixel) { return !isFinite(pixel); };
    const auto first = std::ranges::find_if(reference, isBad);
    if (first == reference.end()) return;
    const auto i = static_cast<size_t>(first - reference.begin());
    fail(ExitCode::BadData, "the reference is not finite at {} of {} pixels, the first is ({}, {})",
         std::ranges::count_if(reference, isBad), reference.size(), i % size_t(width), i / size_t(width));
}

double relativeVariance(std::span<const glm::vec3> reference, std::span<const glm::vec3> variance) {
    double sum = 0;
    for (size_t i = 0; i < reference.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double r = reference[i][c];
            sum += variance[i][c] / (r * r + kEpsilon);
        }
    return sum / (3.0 * static_cast<double>(reference.size()));
}

ImageMetrics compareImages(int width, int height, std::span<const glm::vec3> test,
                           std::span<const glm::vec3> reference) {
    checkSizes(width, height, test, reference);
    checkReference(width, reference);
    ImageMetrics sum;
    double testLuminance = 0;
    double referenceLuminance = 0;
    uint64_t values = 0;
    for (size_t i = 0; i < test.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            if (!std::isfinite(test[i][c])) {
                ++sum.nonFinite;
                continue;
            }
            const double t = test[i][c];
            const double r = reference[i][c];
            sum.mse += (t - r) * (t - r);
            sum.relMse += (t - r) * (t - r) / (r * r + kEpsilon);
            sum.mape += std::abs(t - r) / (std::abs(r) + kEpsilon);
            ++values;
        }
        if (!isFinite(test[i])) ++sum.nonFinitePixels;
        if (!isFinite(test[i])) continue; // a pixel counts for the luminances in both pictures or in none
        testLuminance += luminance(test[i]);
        referenceLuminance += luminance(reference[i]);
    }
    const double count = values ? static_cast<double>(values) : std::numeric_limits<double>::quiet_NaN();
    return {sum.mse / count,
            sum.relMse / count,
            sum.mape / count,
            values ? ratio(testLuminance, referenceLuminance) : count,
            meanFlip(width, height, test, reference),
            sum.nonFinite,
            sum.nonFinitePixels};
}

std::vector<glm::vec3> errorSigns(int width, int height, std::span<const glm::vec3> test,
                                  std::span<const glm::vec3> reference) {
    checkSizes(width, height, test, reference);
    checkReference(width, reference);
    std::vector<glm::vec3> signs(test.size(), glm::vec3(0.0f));
    for (size_t i = 0; i < test.size(); ++i) {
        if (!isFinite(test[i])) continue;
        const double r = luminance(reference[i]);
        const double error = (luminance(test[i]) - r) / (std::abs(r) + kEpsilon);
        signs[i] = {std::max(error, 0.0), 0.0, std::max(-error, 0.0)};
    }
    return signs;
}

} // namespace irradia
