// LDR-FLIP: the difference a viewer sees when flipping between two pictures (Andersson, Nilsson,
// Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference Evaluator for Alternating Images", HPG
// 2020).
#pragma once

#include "engine/image/image.h"

namespace irradia {

// A 0.7 m wide monitor of 3840 pixels seen from 0.7 m, the paper's default.
constexpr double kPixelsPerDegree = 67.02;

// One error in [0, 1] per pixel. Both pictures have one size; alpha is ignored.
std::vector<float> flipErrors(const Rgba8Image& test, const Rgba8Image& reference,
                              double pixelsPerDegree = kPixelsPerDegree);

} // namespace irradia
