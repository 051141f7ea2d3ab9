#include "tests/support/picture_bytes.h"

#include <cstdio>
#include <cstdlib>
// jpeglib.h needs <cstdio> before it.
#include <jpeglib.h>
#include <png.h>

namespace irradia::test {
namespace {

void appendBytes(png_structp png, png_bytep bytes, size_t count) {
    auto* out = static_cast<std::vector<uint8_t>*>(png_get_io_ptr(png));
    out->insert(out->end(), bytes, bytes + count);
}

void setTransparency(png_structp png, png_infop info, const PngForm& form) {
    if (!form.paletteAlpha.empty())
        png_set_tRNS(png, info, form.paletteAlpha.data(), static_cast<int>(form.paletteAlpha.size()),
                     nullptr);
    if (form.transparent.empty()) return;
    png_color_16 colour{};
    colour.gray = colour.red = form.transparent.front();
    if (form.transparent.size() == 3) {
        colour.green = form.transparent[1];
        colour.blue = form.transparent[2];
    }
    png_set_tRNS(png, info, nullptr, 0, &colour);
}

void setHeader(png_structp png, png_infop info, const PngForm& form) {
    png_set_IHDR(png, info, static_cast<uint32_t>(form.width), static_cast<uint32_t>(form.height),
                 form.bitDepth, form.colourType, form.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    std::vector<png_color> palette;
    for (size_t i = 0; i + 2 < form.palette.size(); i += 3)
        palette.push_back({form.palette[i], form.palette[i + 1], form.palette[i + 2]});
    if (!palette.empty()) png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    setTransparency(png, info, form);
}

} // namespace

std::vector<uint8_t> makePng(const PngForm& form, std::vector<uint8_t> rows) {
    std::vector<uint8_t> bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &bytes, appendBytes, nullptr);
    setHeader(png, info, form);
    png_write_info(png, info);
    std::vector<png_bytep> rowPointers;
    for (int y = 0; y < form.height; ++y)
        rowPointers.push_back(rows.data() + static_cast<size_t>(y) * png_get_rowbytes(png, info));
    png_write_image(png, rowPointers.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

std::vector<uint8_t> makeJpeg(JpegForm form, int width, int height, std::vector<uint8_t> samples) {
    jpeg_compress_struct encoder{};
    jpeg_error_mgr errors{};
    encoder.err = jpeg_std_error(&errors);
    jpeg_create_compress(&encoder);
    unsigned char* out = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&encoder, &out, &size);
    encoder.image_width = static_cast<JDIMENSION>(width);
    encoder.image_height = static_cast<JDIMENSION>(height);
    const bool inks = form == JpegForm::Cmyk || form == JpegForm::Ycck || form == JpegForm::CmykPlain;
    encoder.input_components = form == JpegForm::Grey ? 1 : inks ? 4 : 3;
    encoder.in_color_space = form == JpegForm::Grey ? JCS_GRAYSCALE : inks ? JCS_CMYK : JCS_RGB;
    jpeg_set_defaults(&encoder);
    if (form == JpegForm::Ycck) jpeg_set_colorspace(&encoder, JCS_YCCK);
    if (form == JpegForm::CmykPlain) encoder.write_Adobe_marker = FALSE;
    jpeg_set_quality(&encoder, 100, TRUE);
    encoder.comp_info[0].h_samp_factor = encoder.comp_info[0].v_samp_factor = 1;
    if (form == JpegForm::Progressive) jpeg_simple_progression(&encoder);
    jpeg_start_compress(&encoder, TRUE);
    while (encoder.next_scanline < encoder.image_height) {
        JSAMPROW row =
            samples.data() + size_t(encoder.input_components) * encoder.image_width * encoder.next_scanline;
        jpeg_write_scanlines(&encoder, &row, 1);
    }
    jpeg_finish_compress(&encoder);
    jpeg_destroy_compress(&encoder);
    std::vector<uint8_t> bytes(out, out + size);
    std::free(out);
    return bytes;
}

} // namespace irradia::test
