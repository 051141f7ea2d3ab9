// Pictures in memory and on disk. A file is written as a temporary beside its target, synced and renamed:
// a killed run leaves the old file or the new one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace irradia {

// Named float channels of one size, first row on top, and attributes: what an EXR file holds. R, G, B are
// linear with the primaries of Rec. 709, which the file says too.
struct LayeredImage {
    int width = 0;
    int height = 0;
    std::map<std::string, std::vector<float>> channels; // "R", "G", "B", "Albedo.R", "N.X", "Variance.R", ...
    std::map<std::string, std::string> attributes;      // "irradia.seed" -> "1"
    std::map<std::string, glm::mat4> matrices;          // "worldToCamera"; of column vectors, as GLSL's
    std::string name = "image";                         // of the file it came from, for errors
    glm::mat3 toRec709{1.0f}; // of the R, G, B channels, whose primaries may be others

    // Layer "" is R, G, B; "N" with names "XYZ" is N.X, N.Y, N.Z.
    void setRgb(const std::string& layer, std::span<const glm::vec3> pixels, const char* names = "RGB");
    // Colours in linear Rec. 709; of a layer that has but Y, grey. Throws BadData naming the first channel
    // that is missing.
    std::vector<glm::vec3> rgb(const std::string& layer = "", const char* names = "RGB") const;
};

// 8-bit RGBA, 4 bytes a pixel, first row on top.
struct Rgba8Image {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> pixels;
};

// EXR scanlines, float, ZIP. Throws Error (Io, NotFound, BadData) naming the file.
void writeExr(const std::filesystem::path& file, const LayeredImage& image);
// Of several parts the first that holds the layer is read (as R, G, B or Y), all its channels. A layer may be
// called by its part's name too, alone or as PART.LAYER. The picture is that of the display window.
LayeredImage readExr(const std::filesystem::path& file, const std::string& layer = "");

// Radiance .hdr (RGBE, plain and run-length coded).
LayeredImage readHdr(const std::filesystem::path& file);

// PNG, JPEG and WebP from memory, told apart by their first bytes; `name` is used in errors. At most 2^26
// pixels.
Rgba8Image decodeImage(std::span<const uint8_t> bytes, const std::string& name);

// 8-bit RGB, or RGBA where any pixel is not opaque; tagged sRGB.
std::vector<uint8_t> encodePng(const Rgba8Image& image);
void writePng(const std::filesystem::path& file, const Rgba8Image& image);

// Writes bytes atomically (temporary, fsync, rename). Throws Error(Io).
void writeFileAtomically(const std::filesystem::path& file, std::span<const uint8_t> bytes);

// Throws that Error(Io) now rather than after long work. Leaves nothing behind.
void requireWritable(const std::filesystem::path& file);

} // namespace irradia
