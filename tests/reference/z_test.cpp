#include "tests/reference/z_test.h"
#include "tests/reference/statistics.h"
#include <fmt/format.h>

namespace irradia::reference {

namespace {

struct PixelTests {
    double accepted = 0.0;
    double worst = 0.0;
    int worstPixel = 0;
};

// z = difference / sqrt(sum of variances), two-sided, each at Sidak's level for all of them. NaN is
// refused.
PixelTests testPixels(const ImageEstimate& first, const ImageEstimate& second,
                      const ZTestSettings& settings) {
    const double level = sidakLevel(settings.alpha, 3 * first.size());
    PixelTests result;
    size_t accepted = 0;
    for (size_t i = 0; i < first.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double a = first.mean[i][c], b = second.mean[i][c];
            const double floor = settings.relativeFloor * std::fmax(std::abs(a), std::abs(b)) + 1e-12;
            const double variance = first.variance[i][c] + second.variance[i][c] + floor * floor;
            double z = std::abs(a - b) / std::sqrt(variance);
            if (!std::isfinite(z) || !std::isfinite(variance)) z = INFINITY;
            if (normalTwoSided(z) > level) ++accepted;
            if (z > result.worst) result.worst = z, result.worstPixel = static_cast<int>(i);
        }
    result.accepted = static_cast<double>(accepted) / (3.0 * static_cast<double>(first.size()));
    return result;
}

// Mean luminance and its variance; the channels of a pixel are taken as fully correlated, pixels as
// independent.
Vec2 meanLuminance(const ImageEstimate& image) {
    Vec2 sum(0.0);
    for (size_t i = 0; i < image.size(); ++i) {
        const double sigma = luminance(glm::sqrt(image.variance[i]));
        sum += Vec2(luminance(image.mean[i]), sigma * sigma);
    }
    const double count = static_cast<double>(image.size());
    return {sum.x / count, sum.y / (count * count)};
}

} // namespace

ImageEstimate blockMeans(const ImageEstimate& image, int size) {
    ImageEstimate blocks;
    blocks.width = (image.width + size - 1) / size;
    blocks.height = (image.height + size - 1) / size;
    for (int by = 0; by < blocks.height; ++by)
        for (int bx = 0; bx < blocks.width; ++bx) {
            Vec3 mean(0.0), variance(0.0);
            double count = 0.0;
            for (int y = by * size; y < std::min((by + 1) * size, image.height); ++y)
                for (int x = bx * size; x < std::min((bx + 1) * size, image.width); ++x, ++count) {
                    mean += image.mean[static_cast<size_t>(y) * image.width + x];
                    variance += image.variance[static_cast<size_t>(y) * image.width + x];
                }
            blocks.mean.push_back(mean / count);
            blocks.variance.push_back(variance / (count * count));
        }
    return blocks;
}

ZTestResult zTest(const ImageEstimate& first, const ImageEstimate& second, const ZTestSettings& settings) {
    const PixelTests pixels = testPixels(first, second, settings);
    const PixelTests blocks =
        testPixels(blockMeans(first, settings.blockSize), blockMeans(second, settings.blockSize), settings);
    const Vec2 a = meanLuminance(first), b = meanLuminance(second);
    ZTestResult result;
    result.acceptedPixels = pixels.accepted;
    result.acceptedBlocks = blocks.accepted;
    result.meanRatio = a.x / b.x;
    result.meanRatioSigma = result.meanRatio * std::sqrt(a.y / (a.x * a.x) + b.y / (b.x * b.x));
    result.worstPixelZ = pixels.worst;
    result.worstBlockZ = blocks.worst;
    result.worstPixel = pixels.worstPixel;
    return result;
}

std::string ZTestResult::summary() const {
    return fmt::format(
        "pixels accepted {:.4f} (worst z {:.2f} at {}), blocks accepted {:.4f} (worst z {:.2f}), "
        "mean ratio {:.5f} +- {:.5f}",
        acceptedPixels, worstPixelZ, worstPixel, acceptedBlocks, worstBlockZ, meanRatio, meanRatioSigma);
}

} // namespace irradia::reference
