// A picture to learn, and how far another one is from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace irradia {

// One binding holds it: 128 MiB of pixels of 8 bytes.
constexpr uint64_t kMaxPicturePixels = uint64_t{1} << 24;

struct Picture {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint64_t> pixels; // R, G, B (linear) and 0 as halves, in rows, first row on top

    glm::vec3 colour(size_t pixel) const;
};

// PNG or JPEG (sRGB is decoded, transparency left out) or EXR. Throws Error: NotFound, Io, BadData.
Picture loadPicture(const std::filesystem::path& file);

// Sums the squared differences of colours as a screen shows them: sRGB, clamped to [0, 1].
class DisplayError {
public:
    void add(const glm::vec3& colour, const glm::vec3& reference);
    double psnr() const; // dB: -10 log10 of the mean over pixels and channels; peak 1

private:
    double sum_ = 0;
    uint64_t count_ = 0;
};

} // namespace irradia
