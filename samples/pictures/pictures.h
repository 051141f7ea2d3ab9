// What the figures and references of this folder are made with: pictures in a row, the mean of pictures, and
// how much two of one scene differ.
#pragma once

#include "engine/image/image.h"
#include <filesystem>
#include <span>

namespace irradia {

// Side by side as a screen shows them, with a white gutter between; each pixel becomes scale x scale.
// All must be of one size: throws Error(BadData) naming the first that is not.
Rgba8Image pictureRow(std::span<const LayeredImage> pictures, int scale);

// R, G and B, every picture counting alike. Attributes on which the pictures differ are joined by commas.
LayeredImage meanPicture(std::span<const LayeredImage> pictures);

// Variance of pictures like a and b, which differ in their seed alone: the mean over pixels and channels of
// (a - b)^2 / 2 / (reference^2 + 0.01).
struct Noise {
    double most = 0.0; // of the pixels, the largest hundredth left out, which a few bright paths decide
    double all = 0.0;
};
Noise noiseOf(const LayeredImage& a, const LayeredImage& b, const LayeredImage& reference);

// R, G and B in half floats: relative steps of 2^-11 at most. Throws Error(BadData) where a value is beyond.
void writeHalfExr(const std::filesystem::path& file, const LayeredImage& picture);

} // namespace irradia
