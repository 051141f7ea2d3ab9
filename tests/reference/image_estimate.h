// A picture estimated by Monte Carlo: what the path tracer returns and the tests compare.
#pragma once

#include "tests/reference/math.h"
#include <algorithm>
#include <vector>

namespace irradia::reference {

struct ImageEstimate {
    int width = 0;
    int height = 0;
    std::vector<Vec3> mean;     // linear Rec. 709 radiance; width * height, first row at the top
    std::vector<Vec3> variance; // of the mean (not of one sample)

    size_t size() const { return mean.size(); }
};

// Median over the pixels that are not black of standard deviation / mean, both of luminance (channels taken
// as fully correlated): how noisy a typical pixel is. 0 if all are black.
inline double medianRelativeSigma(const ImageEstimate& image) {
    std::vector<double> sigmas;
    for (size_t i = 0; i < image.size(); ++i)
        if (const double mean = luminance(image.mean[i]); mean > 0.0)
            sigmas.push_back(luminance(glm::sqrt(image.variance[i])) / mean);
    if (sigmas.empty()) return 0.0;
    const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
    std::nth_element(sigmas.begin(), middle, sigmas.end());
    return *middle;
}

// Two independent estimates of the same picture, from so many samples a pixel each, as one of all samples.
inline ImageEstimate merged(const ImageEstimate& a, double samplesA, const ImageEstimate& b,
                            double samplesB) {
    const double shareA = samplesA / (samplesA + samplesB), shareB = 1.0 - shareA;
    ImageEstimate both = a;
    for (size_t i = 0; i < both.size(); ++i) {
        both.mean[i] = shareA * a.mean[i] + shareB * b.mean.at(i);
        both.variance[i] = shareA * shareA * a.variance[i] + shareB * shareB * b.variance.at(i);
    }
    return both;
}

} // namespace irradia::reference
