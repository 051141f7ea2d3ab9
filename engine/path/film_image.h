// The film as it is read back: means over frames and how sure they are.
#pragma once

#include "engine/image/image.h"
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace irradia {

// Pixels in rows, first row on top.
struct FilmImage {
    int width = 0;
    int height = 0;
    uint32_t frames = 0;
    uint32_t samplesPerFrame = 1;
    std::vector<glm::vec3> mean;     // linear Rec. 709 radiance
    std::vector<glm::vec3> variance; // of the mean, estimated over frames; empty below two frames

    // AOV layers; empty unless gathered. Means over the samples that hit something.
    std::vector<glm::vec3> albedo;
    std::vector<glm::vec3> normal;   // shading normal, world space, not renormalised
    std::vector<glm::vec3> position; // world space, as the file has it
    std::vector<float> depth;        // along the camera's axis; infinity where nothing was hit

    void reserve(size_t pixels, bool hasVariance, bool hasLayers);
    // Bytes that a film of so many pixels and its layers as toLayers makes them take on the host.
    static uint64_t hostBytes(uint64_t pixels, bool hasLayers);
};

// A film that holds no frame is no picture. Throws Error(Internal).
void requireFrames(const FilmImage& film);

// Channels by pbrt's names: R G B, Variance.*, SampleCount.V, and Albedo.*, N.*, P.*, Z where gathered.
// Throws as requireFrames.
LayeredImage toLayers(const FilmImage& film);

} // namespace irradia
