// PNG and JPEG files made in memory by libpng and libjpeg, in every form a decoder must read.
#pragma once

#include <cstdint>
#include <vector>

namespace irradia::test {

struct PngForm {
    int width = 0;
    int height = 0;
    int bitDepth = 8;
    int colourType = 2; // PNG's: 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
    bool interlaced = false;
    std::vector<uint8_t> palette;        // RGB triples
    std::vector<uint8_t> paletteAlpha;   // tRNS of a palette
    std::vector<uint16_t> transparent{}; // tRNS of grey (1 value) or RGB (3 values)
};
// `rows` as PNG stores them: packed bits, 16-bit values with the high byte first.
std::vector<uint8_t> makePng(const PngForm& form, std::vector<uint8_t> rows);

enum class JpegForm { Grey, Colour, Progressive, Cmyk, Ycck, CmykPlain }; // CmykPlain: no Adobe marker
// Interleaved 8-bit samples: 1, 3, 3 or 4 a pixel. Quality 100, no chroma subsampling.
std::vector<uint8_t> makeJpeg(JpegForm form, int width, int height, std::vector<uint8_t> samples);

} // namespace irradia::test
