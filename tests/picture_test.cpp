// PNG and JPEG in every form textures come in, and in forms made to hurt.
#include "engine/image/image.h"
#include "tests/support/expect_error.h"
#include "tests/support/picture_bytes.h"
#include "tests/support/temporary_folder.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <random>
#include <zlib.h>

using namespace irradia;
using namespace irradia::test;

namespace {

using Bytes = std::vector<uint8_t>;

Rgba8Image noisePicture(int width, int height, bool transparent) {
    std::mt19937 random(11);
    Rgba8Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i)
        for (int c = 0; c < 4; ++c)
            image.pixels.push_back(c == 3 && !transparent ? 255 : static_cast<uint8_t>(random()));
    return image;
}

Bytes decoded(const Bytes& bytes) {
    return decodeImage(bytes, "picture").pixels;
}

void putBigEndian(Bytes& bytes, size_t at, uint32_t value) {
    for (size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<uint8_t>(value >> (24 - 8 * i));
}

// Changes the size in a PNG's header and mends the header's checksum.
Bytes claimPngSize(Bytes png, uint32_t width, uint32_t height) {
    constexpr size_t kHeader = 12; // "IHDR", width, height, ...
    putBigEndian(png, kHeader + 4, width);
    putBigEndian(png, kHeader + 8, height);
    putBigEndian(png, kHeader + 17, static_cast<uint32_t>(crc32(0, png.data() + kHeader, 17)));
    return png;
}

// Changes the size in a JPEG's frame header (SOF0: marker, length, precision, height, width).
Bytes claimJpegSize(Bytes jpeg, uint16_t width, uint16_t height) {
    const Bytes marker{0xff, 0xc0};
    const auto at = static_cast<size_t>(std::ranges::search(jpeg, marker).begin() - jpeg.begin());
    REQUIRE(at + 9 < jpeg.size());
    jpeg[at + 5] = static_cast<uint8_t>(height >> 8);
    jpeg[at + 6] = static_cast<uint8_t>(height);
    jpeg[at + 7] = static_cast<uint8_t>(width >> 8);
    jpeg[at + 8] = static_cast<uint8_t>(width);
    return jpeg;
}

Bytes gradient(int width, int height, int components) {
    Bytes samples;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < components; ++c)
                samples.push_back(static_cast<uint8_t>(20 + 4 * x + 3 * y + 40 * c));
    return samples;
}

int largestDifference(const Bytes& rgba, const Bytes& samples, size_t components) {
    int largest = 0;
    for (size_t i = 0; i < rgba.size() / 4; ++i)
        for (size_t c = 0; c < 3; ++c)
            largest = std::max(
                largest, std::abs(rgba[4 * i + c] - samples[components * i + std::min(c, components - 1)]));
    return largest;
}

} // namespace

TEST_CASE("a written PNG gives back every pixel") {
    const TemporaryFolder folder;
    for (const bool transparent : {false, true}) {
        const Rgba8Image image = noisePicture(31, 17, transparent);
        writePng(folder / "a.png", image);
        const Bytes bytes = folder.read("a.png");
        const Rgba8Image read = decodeImage(bytes, "a.png");
        CHECK(read.width == 31);
        CHECK(read.height == 17);
        CHECK(read.pixels == image.pixels);
        CHECK(bytes[25] == (transparent ? 6 : 2)); // colour type: opaque pictures are RGB
        CHECK(bytes == encodePng(image));
    }
    CHECK(folder.entries() == 1);
    expectError(ExitCode::Internal, "PNG", [] { encodePng({3, 3, Bytes(12)}); });
    expectError(ExitCode::Io, "nowhere",
                [&] { writePng(folder / "nowhere/a.png", noisePicture(1, 1, false)); });
}

TEST_CASE("every form of PNG becomes RGBA") {
    SECTION("1-bit grey") {
        CHECK(decoded(makePng({.width = 3, .height = 1, .bitDepth = 1, .colourType = 0}, {0b10100000})) ==
              Bytes{255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255});
    }
    SECTION("4-bit grey with a transparent value") {
        CHECK(decoded(makePng({.width = 2, .height = 1, .bitDepth = 4, .colourType = 0, .transparent = {0x3}},
                              {0x3a})) == Bytes{0x33, 0x33, 0x33, 0, 0xaa, 0xaa, 0xaa, 255});
    }
    SECTION("grey and alpha") {
        CHECK(decoded(makePng({.width = 2, .height = 1, .colourType = 4}, {10, 20, 30, 40})) ==
              Bytes{10, 10, 10, 20, 30, 30, 30, 40});
    }
    SECTION("16-bit grey, rounded") {
        // 0x7fff / 257 = 127.498, 0x8080 / 257 = 128
        CHECK(decoded(makePng({.width = 2, .height = 1, .bitDepth = 16, .colourType = 0},
                              {0x7f, 0xff, 0x80, 0x80})) == Bytes{127, 127, 127, 255, 128, 128, 128, 255});
    }
    SECTION("16-bit RGBA") {
        CHECK(decoded(makePng({.width = 1, .height = 1, .bitDepth = 16, .colourType = 6},
                              {1, 1, 2, 2, 255, 255, 128, 128})) == Bytes{1, 2, 255, 128});
    }
    SECTION("16-bit RGB with a transparent colour, told apart by its low bytes") {
        CHECK(decoded(makePng(
                  {.width = 2, .height = 1, .bitDepth = 16, .colourType = 2, .transparent = {257, 257, 257}},
                  {1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 1})) == Bytes{1, 1, 1, 0, 1, 1, 1, 255});
    }
    SECTION("palette with alpha, 2 bits") {
        const PngForm form{.width = 3,
                           .height = 1,
                           .bitDepth = 2,
                           .colourType = 3,
                           .palette = {1, 2, 3, 4, 5, 6, 7, 8, 9},
                           .paletteAlpha = {100, 200}};
        CHECK(decoded(makePng(form, {0b00011000})) == Bytes{1, 2, 3, 100, 4, 5, 6, 200, 7, 8, 9, 255});
    }
    SECTION("opaque palette") {
        const PngForm form{.width = 2, .height = 1, .colourType = 3, .palette = {1, 2, 3, 4, 5, 6}};
        CHECK(decoded(makePng(form, {1, 0})) == Bytes{4, 5, 6, 255, 1, 2, 3, 255});
    }
    SECTION("interlaced") {
        const Rgba8Image image = noisePicture(19, 13, true);
        const PngForm form{.width = 19, .height = 13, .colourType = 6, .interlaced = true};
        CHECK(decoded(makePng(form, image.pixels)) == image.pixels);
    }
}

TEST_CASE("JPEG is decoded within its own rounding") {
    // Quality 100 quantises by 1: a smooth picture comes back within the transform's and the colours'
    // rounding.
    for (const JpegForm form : {JpegForm::Grey, JpegForm::Colour, JpegForm::Progressive}) {
        const int components = form == JpegForm::Grey ? 1 : 3;
        const Bytes samples = gradient(24, 16, components);
        const Rgba8Image image = decodeImage(makeJpeg(form, 24, 16, samples), "picture");
        CHECK(image.width == 24);
        CHECK(image.height == 16);
        REQUIRE(image.pixels.size() == 4 * 24 * 16);
        CHECK(largestDifference(image.pixels, samples, static_cast<size_t>(components)) <= 3);
        for (size_t i = 3; i < image.pixels.size(); i += 4) REQUIRE(image.pixels[i] == 255);
    }
}

// The three forms store the same inks: none, all black, and half of each.
TEST_CASE("JPEG of inks becomes RGBA") {
    const auto check = [](JpegForm form, const Bytes& inks, const Bytes& expected) {
        Bytes samples;
        for (int i = 0; i < 16 * 16; ++i) samples.insert(samples.end(), inks.begin(), inks.end());
        const Bytes pixels = decoded(makeJpeg(form, 16, 16, samples));
        REQUIRE(pixels.size() == 4 * 16 * 16);
        for (size_t i = 0; i < pixels.size(); ++i)
            REQUIRE(std::abs(pixels[i] - expected[i % 4]) <= 2); // JPEG's rounding
    };
    for (const JpegForm form : {JpegForm::Cmyk, JpegForm::Ycck}) { // Adobe's: 255 is no ink
        check(form, {255, 255, 255, 255}, {255, 255, 255, 255});
        check(form, {255, 255, 255, 0}, {0, 0, 0, 255});
        check(form, {200, 100, 50, 128}, {100, 50, 25, 255});
    }
    check(JpegForm::CmykPlain, {0, 0, 0, 0}, {255, 255, 255, 255});
    check(JpegForm::CmykPlain, {0, 0, 0, 255}, {0, 0, 0, 255});
    check(JpegForm::CmykPlain, {55, 155, 205, 127}, {100, 50, 25, 255});
}

TEST_CASE("what is neither PNG, JPEG nor WebP is refused by name") {
    for (const char* text : {"", "\x89PN", "GIF89a", "RIFFxxxxWAVEfmt ", "RIFFxxxxWEB", "just text"}) {
        const std::string bytes = text;
        expectError(ExitCode::BadData, "wood.png: neither", [&] {
            decodeImage({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, "wood.png");
        });
    }
}

TEST_CASE("pictures cut short anywhere are refused") {
    const Bytes png = encodePng(noisePicture(9, 7, true));
    const Bytes interlaced = makePng({.width = 9, .height = 7, .colourType = 6, .interlaced = true},
                                     noisePicture(9, 7, true).pixels);
    const Bytes jpeg = makeJpeg(JpegForm::Colour, 40, 40, gradient(40, 40, 3));
    const Bytes progressive = makeJpeg(JpegForm::Progressive, 40, 40, gradient(40, 40, 3));
    for (const Bytes& whole : {png, interlaced, jpeg, progressive}) {
        REQUIRE_NOTHROW(decodeImage(whole, "whole"));
        for (size_t length = 0; length < whole.size(); ++length) {
            INFO("cut at " << length << " of " << whole.size());
            expectError(ExitCode::BadData, "cut.bin",
                        [&] { decodeImage(std::span(whole).first(length), "cut.bin"); });
        }
    }
}

TEST_CASE("absurd sizes are refused before they cost memory") {
    const Bytes png = encodePng(noisePicture(4, 4, false));
    const Bytes jpeg = makeJpeg(JpegForm::Colour, 16, 16, gradient(16, 16, 3));
    const auto refuse = [](const std::string& thing, const Bytes& bytes) {
        expectError(ExitCode::BadData, "big.bin: " + thing, [&] { decodeImage(bytes, "big.bin"); });
    };
    refuse("2147483647 x 2147483647 pixels", claimPngSize(png, 0x7fffffff, 0x7fffffff));
    refuse("16384 x 8192 pixels", claimPngSize(png, 16384, 8192));
    refuse("not a usable PNG", claimPngSize(png, 0, 4));
    refuse("not a usable PNG", claimPngSize(png, 0x80000000, 1));
    // 2^26 pixels are allowed, but not out of nothing: deflate cannot grow data more than 1032 times.
    refuse(std::to_string(png.size()) + " bytes of PNG cannot hold 8192 x 8192",
           claimPngSize(png, 8192, 8192));
    refuse("65500 x 65500 pixels", claimJpegSize(jpeg, 65500, 65500));
    refuse("not a usable JPEG", claimJpegSize(jpeg, 0, 16));
    refuse("damaged JPEG", claimJpegSize(jpeg, 1024, 1024));
}

TEST_CASE("damaged pictures are decoded or refused, nothing else") {
    const Bytes png = makePng({.width = 24, .height = 24, .colourType = 6, .interlaced = true},
                              noisePicture(24, 24, true).pixels);
    const Bytes jpeg = makeJpeg(JpegForm::Progressive, 40, 40, gradient(40, 40, 3));
    std::mt19937 random(5);
    int refused = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        Bytes bytes = trial % 2 ? png : jpeg;
        for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<uint8_t>(random());
        try {
            decodeImage(bytes, "damaged");
        } catch (const Error& error) {
            CHECK(error.code() == ExitCode::BadData);
            ++refused;
        }
    }
    CHECK(refused > 400); // nearly all of the PNGs, whose chunks carry checksums
}
