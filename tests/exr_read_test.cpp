// EXR files as programs write them: parts, layers, crops, grey, luminance with chroma, other primaries.
#include "engine/image/picture_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <map>

using namespace irradia;
using Catch::Matchers::WithinAbs;
using irradia::test::expectError;
using irradia::test::TemporaryFolder;

namespace {

// Channels of one value each, that value the same at every pixel of the data window.
using Flat = std::map<std::string, float>;

struct Part {
    Imf::Header header;
    Flat channels;
};

Part part(const Flat& channels, const Imath::Box2i& display, const Imath::Box2i& data) {
    Part result{Imf::Header(display, data), channels};
    for (const auto& entry : channels) result.header.channels().insert(entry.first, Imf::Channel(Imf::FLOAT));
    return result;
}

Part part(const Flat& channels, const std::string& name = "") {
    const Imath::Box2i window({0, 0}, {3, 1});
    Part result = part(channels, window, window);
    if (name.empty()) return result;
    result.header.setName(name);
    result.header.setType(Imf::SCANLINEIMAGE);
    return result;
}

// The pixels that a frame buffer points into.
struct Pixels {
    explicit Pixels(const Part& part) {
        const Imath::Box2i& window = part.header.dataWindow();
        const auto count = size_t(window.size().x + 1) * size_t(window.size().y + 1);
        for (const auto& [name, value] : part.channels) {
            values[name].assign(count, value);
            frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values[name].data(), window));
        }
        rows = window.size().y + 1;
    }
    std::map<std::string, std::vector<float>> values;
    Imf::FrameBuffer frame;
    int rows = 0;
};

std::string write(const std::filesystem::path& file, const Part& part) {
    const Pixels pixels(part);
    Imf::OutputFile output(file.c_str(), part.header);
    output.setFrameBuffer(pixels.frame);
    output.writePixels(pixels.rows);
    return file.string();
}

std::string write(const std::filesystem::path& file, const std::vector<Part>& parts) {
    std::vector<Imf::Header> headers;
    for (const Part& part : parts) headers.push_back(part.header);
    Imf::MultiPartOutputFile output(file.c_str(), headers.data(), int(headers.size()));
    for (size_t i = 0; i < parts.size(); ++i) {
        const Pixels pixels(parts[i]);
        Imf::OutputPart out(output, int(i));
        out.setFrameBuffer(pixels.frame);
        out.writePixels(pixels.rows);
    }
    return file.string();
}

std::vector<glm::vec3> pixelsOf(const std::string& text) {
    const PictureName name = parsePictureName(text);
    return readPicture(name).rgb(name.layer);
}

glm::vec3 firstPixel(const std::string& text) {
    return pixelsOf(text).at(0);
}

const Flat kRgb{{"R", 1}, {"G", 2}, {"B", 3}};

} // namespace

TEST_CASE("a picture is that of its display window, black where the file holds nothing") {
    const TemporaryFolder folder;
    SECTION("a crop") {
        const auto file = write(folder / "crop.exr", part(kRgb, {{-1, 2}, {4, 5}}, {{1, 3}, {2, 3}}));
        const LayeredImage image = readExr(file);
        CHECK((image.width == 6 && image.height == 4));
        const auto pixels = image.rgb();
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 6; ++x) {
                const bool inside = y == 1 && (x == 2 || x == 3);
                CHECK(pixels[size_t(y) * 6 + size_t(x)] == (inside ? glm::vec3(1, 2, 3) : glm::vec3(0)));
            }
    }
    SECTION("more than is shown is cut off") {
        const auto file = write(folder / "overscan.exr", part(kRgb, {{0, 0}, {1, 1}}, {{-3, -1}, {5, 7}}));
        CHECK(pixelsOf(file) == std::vector<glm::vec3>(4, {1, 2, 3}));
    }
    SECTION("nothing of it shown, or hardly anything held") {
        const auto beside = write(folder / "a.exr", part(kRgb, {{0, 0}, {1, 1}}, {{5, 5}, {6, 6}}));
        expectError(ExitCode::BadData, "a.exr: its pixels lie outside", [&] { readExr(beside); });
        const auto black = write(folder / "b.exr", part(kRgb, {{0, 0}, {8191, 8191}}, {{0, 0}, {1, 1}}));
        expectError(ExitCode::BadData, "b.exr: 8192 x 8192 pixels are shown", [&] { readExr(black); });
    }
}

TEST_CASE("grey pictures are grey, layers and their grey too") {
    const TemporaryFolder folder;
    CHECK(firstPixel(write(folder / "grey.exr", part({{"Y", 5}}))) == glm::vec3(5));
    const auto layers = write(folder / "layers.exr", part({{"R", 1},
                                                           {"G", 2},
                                                           {"B", 3},
                                                           {"sun.R", 4},
                                                           {"sun.G", 5},
                                                           {"sun.B", 6},
                                                           {"fog.Y", 7},
                                                           {"View.Combined.R", 8},
                                                           {"View.Combined.G", 9},
                                                           {"View.Combined.B", 10}}));
    CHECK(firstPixel(layers) == glm::vec3(1, 2, 3));
    CHECK(firstPixel(layers + ":sun") == glm::vec3(4, 5, 6));
    CHECK(firstPixel(layers + ":fog") == glm::vec3(7));
    CHECK(firstPixel(layers + ":View.Combined") == glm::vec3(8, 9, 10));
    expectError(ExitCode::BadData, "layers.exr: has no layer 'moon' with R, G, B or Y, only B, G, R, View",
                [&] { firstPixel(layers + ":moon"); });
    expectError(ExitCode::BadData, "depth.exr: has no channel R, only Z", [&] {
        firstPixel(write(folder / "depth.exr", part({{"Z", 1}})));
    });
}

TEST_CASE("of several parts the first with colours is the picture; the others go by their names") {
    const TemporaryFolder folder;
    const auto file =
        write(folder / "parts.exr", {part({{"Z", 9}}, "depth"), part(kRgb, "rgb"),
                                     part({{"R", 4}, {"G", 5}, {"B", 6}, {"glow.Y", 7}}, "left")});
    CHECK(firstPixel(file) == glm::vec3(1, 2, 3));
    CHECK(firstPixel(file + ":rgb") == glm::vec3(1, 2, 3));
    CHECK(firstPixel(file + ":left") == glm::vec3(4, 5, 6));
    CHECK(firstPixel(file + ":left.glow") == glm::vec3(7));
    CHECK(firstPixel(file + ":glow") == glm::vec3(7));
    expectError(ExitCode::BadData, "Z in part 'depth'; B, G, R in part 'rgb'",
                [&] { firstPixel(file + ":depth"); });
    const auto none = write(folder / "none.exr", {part({{"Z", 9}}, "a"), part({{"N.X", 1}}, "b")});
    expectError(ExitCode::BadData, "has no channel R", [&] { firstPixel(none); });
}

TEST_CASE("luminance with subsampled chroma gives back its colours") {
    const TemporaryFolder folder;
    const std::string file = (folder / "chroma.exr").string();
    {
        Imf::RgbaOutputFile output(file.c_str(), 8, 6, Imf::WRITE_YC);
        const std::vector<Imf::Rgba> pixels(48, Imf::Rgba(0.25f, 0.5f, 0.125f));
        output.setFrameBuffer(pixels.data(), 1, 8);
        output.writePixels(6);
    }
    const auto pixels = pixelsOf(file);
    REQUIRE(pixels.size() == 48);
    for (const glm::vec3& pixel : pixels) // of halves, filtered
        for (int c = 0; c < 3; ++c) CHECK_THAT(pixel[c], WithinAbs(glm::vec3(0.25f, 0.5f, 0.125f)[c], 2e-3));
}

TEST_CASE("colours of other primaries become Rec. 709's") {
    const TemporaryFolder folder;
    const auto convert = [&](const Imf::Chromaticities& primaries, const Flat& channels) {
        Part wide = part(channels);
        Imf::addChromaticities(wide.header, primaries);
        return firstPixel(write(folder / "wide.exr", wide));
    };
    const auto check = [](const glm::vec3& found, const glm::dvec3& expected, double tolerance) {
        for (int c = 0; c < 3; ++c) CHECK_THAT(found[c], WithinAbs(expected[c], tolerance));
    };
    CHECK(convert({}, kRgb) == glm::vec3(1, 2, 3)); // to the bit

    // ITU-R BT.2087-0, table 3: the inverse of BT.709 to BT.2020, to its four digits.
    const Imf::Chromaticities rec2020({0.708f, 0.292f}, {0.17f, 0.797f}, {0.131f, 0.046f});
    check(convert(rec2020, {{"R", 1}, {"G", 0}, {"B", 0}}), {1.6605, -0.1246, -0.0182}, 2e-4);
    check(convert(rec2020, {{"R", 0}, {"G", 1}, {"B", 0}}), {-0.5876, 1.1329, -0.1006}, 2e-4);
    check(convert(rec2020, {{"R", 1}, {"G", 1}, {"B", 1}}), {1, 1, 1}, 1e-5);

    // ACES2065-1, whose white is another: it stays white. Red as the Academy's AP0 to Rec. 709 (Bradford).
    const Imf::Chromaticities aces({0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f}, {0.32168f, 0.33767f});
    check(convert(aces, {{"R", 1}, {"G", 1}, {"B", 1}}), {1, 1, 1}, 1e-5);
    check(convert(aces, {{"R", 1}, {"G", 0}, {"B", 0}}), {2.5217, -0.2765, -0.0153}, 1e-3);
    CHECK(convert(aces, {{"Y", 2}}) == glm::vec3(2)); // grey has no primaries
}

TEST_CASE("a colon in a name is no layer, an HDR has none") {
    const TemporaryFolder folder;
    write(folder / "a.exr:b", part({{"Y", 5}}));
    write(folder / "A.EXR", part({{"Y", 6}, {"b.Y", 7}}));
    CHECK(firstPixel((folder / "a.exr:b").string()) == glm::vec3(5));
    CHECK(firstPixel((folder / "A.EXR:b").string()) == glm::vec3(7));
    CHECK(parsePictureName("C:/x.exr:l").file == "C:/x.exr");
    CHECK(parsePictureName("x.exr").layer.empty());
    expectError(ExitCode::BadData, "sky.hdr: an HDR picture has no layer 'b'",
                [] { firstPixel("sky.hdr:b"); });
}
