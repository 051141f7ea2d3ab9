// Radiance on a screen: exposure, a tone map, the sRGB curve.
#pragma once

#include "engine/image/image.h"

namespace irradia {

// From radiance, with 1 as a lamp's white where nothing is compressed, to a screen's light in [0, 1].
enum class ToneMap {
    Clip,     // what is above 1 is white
    Reinhard, // L / (1 + L) of the luminance (Reinhard et al. 2002, eq. 3), the colour kept
    Aces,     // Narkowicz 2015's fit to the ACES curve, each channel by itself
};

constexpr const char* kToneMapNames[] = {"clip", "reinhard", "aces"}; // in the order above

struct DisplayOptions {
    double exposure = 0.0; // stops: radiance is multiplied by 2 to this power
    ToneMap toneMap = ToneMap::Clip;
};

// NaN shows as black.
Rgba8Image toDisplay(int width, int height, std::span<const glm::vec3> radiance,
                     const DisplayOptions& options = {});

// The stops that bring the median luminance of what is neither black nor infinite to a grey of 18 %; 0 for a
// picture without any.
double automaticExposure(std::span<const glm::vec3> radiance);

// Of linear Rec. 709.
double luminance(const glm::vec3& rgb);

// The colour of a number of things on a map: black none, blue 1, cyan 2, green 4, yellow 8, red 16 and more;
// in between linear, from 1 on in the number's logarithm.
glm::vec3 heatColour(float number);

} // namespace irradia
