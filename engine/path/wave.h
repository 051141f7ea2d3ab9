// Waves: how a frame's paths are cut into groups that are in flight together. Pure; the cut changes no
// result.
#pragma once

#include "shared/path.h"
#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

namespace irradia {

// 2^log2Samples consecutive samples of each of `pixels` consecutive pixels. From gpu::kFirstTrainingPixel on
// they are no pixels: camera paths, or from gpu::kFirstSurfacePath on paths from the scene's surfaces, that
// are not seen and only train.
struct Wave {
    uint32_t firstPixel = 0;
    uint32_t pixels = 0;
    uint32_t log2Samples = 0;
    uint32_t firstSample = 0; // of the frame's
    bool isLast = true;       // holds the last samples of its pixels

    uint32_t paths() const { return pixels << log2Samples; }
    bool isSeen() const { return firstPixel < gpu::kFirstTrainingPixel; }
    bool startsAtSurfaces() const { return firstPixel >= gpu::kFirstSurfacePath; }
};

// The waves of `pixels` pixels with `samples` samples each, pixels first: all samples of a run of pixels,
// then the next run. Few pixels have several samples in flight, a power of two, so that none of a device's
// lanes is idle and a frame of many samples is few passes.
class Waves {
public:
    // Pixels of a wave begin at multiples of it: ranges of buffers of whole quads are aligned for any
    // device (256 bytes).
    static constexpr uint32_t kPixelAlignment = 16;

    Waves(uint32_t firstPixel, uint32_t pixels, uint32_t samples, uint32_t mostPaths)
        : first_(firstPixel)
        , pixels_(pixels)
        , samples_(samples)
        , mostPaths_(mostPaths) {}

    // Pixels of a wave at most, and paths.
    static uint32_t pixelsOfWave(uint32_t pixels, uint32_t mostPaths) {
        return pixels <= mostPaths ? pixels : std::max(mostPaths / kPixelAlignment, 1u) * kPixelAlignment;
    }
    static uint32_t pathsOfWave(uint32_t pixels, uint32_t samples, uint32_t mostPaths) {
        const uint32_t run = pixelsOfWave(pixels, mostPaths);
        return run << log2Samples(run, samples, mostPaths);
    }

    std::optional<Wave> next() {
        if (pixel_ == pixels_) return std::nullopt;
        const uint32_t whole = pixelsOfWave(pixels_, mostPaths_);
        const uint32_t run = std::min(whole, pixels_ - pixel_); // with as many samples as fit a whole one
        Wave wave{first_ + pixel_, run, log2Samples(whole, samples_ - sample_, mostPaths_), sample_};
        sample_ += 1u << wave.log2Samples;
        wave.isLast = sample_ == samples_;
        if (wave.isLast) {
            sample_ = 0;
            pixel_ += run;
        }
        return wave;
    }

private:
    static uint32_t log2Samples(uint32_t pixels, uint32_t samples, uint32_t mostPaths) {
        return static_cast<uint32_t>(std::bit_width(std::clamp(mostPaths / pixels, 1u, samples))) - 1;
    }

    uint32_t first_, pixels_, samples_, mostPaths_;
    uint32_t pixel_ = 0, sample_ = 0; // of the next wave
};

} // namespace irradia
