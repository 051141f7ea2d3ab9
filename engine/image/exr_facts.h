// What an OpenEXR file says of itself, part by part, and whether its numbers are numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace irradia {

struct ExrChannel {
    std::string name; // "N.X"
    std::string type; // "half", "float" or "uint"
    int xSampling = 1, ySampling = 1;
};

struct ExrAttribute {
    std::string name, type, value; // "irradia.seed", "string", "1"
};

struct ExrWindow {
    int left = 0, top = 0, right = 0, bottom = 0; // all inclusive

    int64_t width() const { return int64_t{right} - left + 1; }
    int64_t height() const { return int64_t{bottom} - top + 1; }
    bool operator==(const ExrWindow&) const = default;
};

struct ExrPart {
    std::string name; // empty in files of one part
    std::string type; // "scanlineimage", "tiledimage", "deepscanline", "deeptile"
    std::string compression;
    ExrWindow dataWindow, displayWindow;
    std::vector<ExrChannel> channels;
    std::vector<std::string> layers;      // "" = R, G, B and what else has no dot, in the order of channels
    std::vector<ExrAttribute> attributes; // irradia.* first; not those that stand above
    // Pixels of which any value is NaN or infinite, subsampled channels aside. None for deep parts and for
    // what is too large to look at.
    std::optional<uint64_t> nonFinitePixels;
};

// Throws Error: NotFound, Io, or BadData for what is no OpenEXR file, or a damaged one.
std::vector<ExrPart> readExrFacts(const std::filesystem::path& file);

} // namespace irradia
