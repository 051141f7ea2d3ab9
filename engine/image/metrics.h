// Error of a test picture t against a reference r, over linear radiance (design: what `compare` prints).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace irradia {

struct ImageMetrics {
    double mse = 0;         // mean of (t - r)^2 over pixels and channels
    double relMse = 0;      // mean of (t - r)^2 / (r^2 + 0.01)
    double mape = 0;        // mean of |t - r| / (|r| + 0.01)
    double meanRatio = 0;   // mean luminance of t / mean luminance of r, over pixels finite in t
    double flip = 0;        // mean LDR-FLIP (Andersson et al. 2020) of the pictures as toDisplay shows them
    uint64_t nonFinite = 0; // non-finite values in t; the means leave them out and are NaN if none remain
    uint64_t nonFinitePixels = 0; // pixels with such a value
};

// Both spans hold width * height pixels. r must be finite; throws Error(BadData) otherwise.
ImageMetrics compareImages(int width, int height, std::span<const glm::vec3> test,
                           std::span<const glm::vec3> reference);

// Of each pixel's luminance (t - r) / (|r| + 0.01): red where t is brighter, blue where it is darker, black
// where it is not finite. As compareImages otherwise.
std::vector<glm::vec3> errorSigns(int width, int height, std::span<const glm::vec3> test,
                                  std::span<const glm::vec3> reference);

// What relMse holds of a reference's own noise: the mean of its pixels' variance / (r^2 + 0.01).
double relativeVariance(std::span<const glm::vec3> reference, std::span<const glm::vec3> variance);

// Throws Error(BadData) with the number of pixels that are not finite, and the first.
void checkReference(int width, std::span<const glm::vec3> reference);

} // namespace irradia
