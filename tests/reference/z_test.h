// Are two independent Monte Carlo pictures estimates of the same one? A z-test for each pixel and channel as
// in Mitsuba's test suite, and on means of 8x8 blocks, which see a small bias that a pixel's noise hides.
#pragma once

#include "tests/reference/image_estimate.h"
#include <string>

namespace irradia::reference {

struct ZTestSettings {
    double alpha =
        0.01; // of the whole picture: each pixel is tested at Sidak's level for the number of pixels
    int blockSize = 8;
    // Standard deviation below which a difference means nothing, relative to the mean: rounding of
    // single-precision film and shading where the estimate has (nearly) no variance, e.g. a light seen
    // directly.
    double relativeFloor = 1e-4;
};

struct ZTestResult {
    double acceptedPixels =
        0.0; // share of pixels times channels; the tests ask for >= 0.9975 as Mitsuba does
    double acceptedBlocks = 0.0; // share of blocks times channels
    double meanRatio = 0.0;      // mean luminance of the first picture over that of the second
    double meanRatioSigma = 0.0; // standard deviation of that ratio
    double worstPixelZ = 0.0;    // largest |z|; infinite for values that are not finite
    double worstBlockZ = 0.0;
    int worstPixel = 0; // index y * width + x

    bool accepted(double share = 0.9975) const { return acceptedPixels >= share && acceptedBlocks >= share; }
    std::string summary() const; // one line
};

// Both pictures must have the same size.
ZTestResult zTest(const ImageEstimate& first, const ImageEstimate& second,
                  const ZTestSettings& settings = {});

// Means over blocks of size x size pixels (smaller at the right and lower edge), with the variance of each.
ImageEstimate blockMeans(const ImageEstimate& image, int size);

} // namespace irradia::reference
