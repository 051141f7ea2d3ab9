// EXR and HDR files, atomic writing and the screen's curve. Decoding of PNG and JPEG: picture_test.
#include "engine/image/image.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <csignal>
#include <cstring>
#include <half.h>
#include <limits>
#include <random>
#include <sys/resource.h>

using namespace irradia;
using irradia::test::expectError;
using irradia::test::TemporaryFolder;

namespace {

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

LayeredImage noiseImage(int width, int height) {
    std::mt19937 random(7);
    std::normal_distribution<float> value(0, 3);
    LayeredImage image;
    image.width = width;
    image.height = height;
    for (const char* name : {"R", "G", "B", "Albedo.R", "SampleCount.V", "Z"}) {
        auto& channel = image.channels[name];
        for (int i = 0; i < width * height; ++i) channel.push_back(value(random));
    }
    return image;
}

std::vector<uint8_t> bytesOf(const std::string& text) {
    return {text.begin(), text.end()};
}

// Half x + y / 2 and unsigned 100000 x + y, in a data window that starts at (-4, 6).
void writeMixedTypes(const std::filesystem::path& file, int subsampling = 1) {
    const Imath::Box2i window({-4, 6}, {-1, 9});
    std::vector<half> halves;
    std::vector<unsigned> integers;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            halves.push_back(half(static_cast<float>(x) + 0.5f * static_cast<float>(y)));
            integers.push_back(static_cast<unsigned>(100000 * x + y));
        }
    Imf::Header header(window, window);
    header.channels().insert("H", Imf::Channel(Imf::HALF, subsampling, subsampling));
    header.channels().insert("U", Imf::Channel(Imf::UINT));
    Imf::FrameBuffer frame;
    frame.insert("H", Imf::Slice::Make(Imf::HALF, halves.data(), window, 0, 0, subsampling, subsampling));
    frame.insert("U", Imf::Slice::Make(Imf::UINT, integers.data(), window));
    Imf::OutputFile output(file.c_str(), header);
    output.setFrameBuffer(frame);
    output.writePixels(4);
}

void putInt32(std::vector<uint8_t>& bytes, size_t at, int32_t value) {
    for (size_t i = 0; i < 4; ++i)
        bytes[at + i] = static_cast<uint8_t>(static_cast<uint32_t>(value) >> (8 * i));
}

// Both windows of an EXR become (0, 0) - (maxX, maxY).
void claimSize(std::vector<uint8_t>& exr, int32_t maxX, int32_t maxY) {
    const std::string kind("box2i\0\x10\0\0\0", 10);
    auto at = exr.begin();
    int windows = 0;
    while ((at = std::search(at, exr.end(), kind.begin(), kind.end())) != exr.end()) {
        const auto values = static_cast<size_t>(at - exr.begin()) + kind.size();
        putInt32(exr, values + 8, maxX);
        putInt32(exr, values + 12, maxY);
        ++at;
        ++windows;
    }
    REQUIRE(windows == 2);
}

} // namespace

TEST_CASE("an EXR gives back every bit, name and attribute") {
    const TemporaryFolder folder;
    LayeredImage image = noiseImage(37, 21);
    using Limits = std::numeric_limits<float>;
    const float special[] = {
        0.0f, -0.0f, Limits::denorm_min(), Limits::max(), Limits::infinity(), Limits::quiet_NaN()};
    std::ranges::copy(special, image.channels["R"].begin());
    image.attributes = {
        {"irradia.seed", "7"}, {"irradia.options", "--spp 4 \"quoted\""}, {"irradia.empty", ""}};
    image.attributes["irradia.aNameLongerThanThirtyTwoCharacters"] = std::string(5000, 'x');
    writeExr(folder / "a.exr", image);

    const LayeredImage read = readExr(folder / "a.exr");
    CHECK(read.width == 37);
    CHECK(read.height == 21);
    CHECK(read.name == (folder / "a.exr").string());
    REQUIRE(read.channels.size() == image.channels.size());
    for (const auto& [name, values] : image.channels) CHECK(sameBits(values, read.channels.at(name)));
    CHECK(read.attributes == image.attributes);
}

TEST_CASE("the same image is the same file") {
    const TemporaryFolder folder;
    writeExr(folder / "a.exr", noiseImage(40, 30));
    writeExr(folder / "b.exr", noiseImage(40, 30));
    CHECK(folder.read("a.exr") == folder.read("b.exr"));
}

TEST_CASE("layers are read as they were set") {
    LayeredImage image;
    image.width = 2;
    image.height = 1;
    const std::vector<glm::vec3> colour{{1, 2, 3}, {4, 5, 6}};
    const std::vector<glm::vec3> normal{{0, 0, 1}, {0, 1, 0}};
    image.setRgb("", colour);
    image.setRgb("N", normal, "XYZ");
    CHECK(image.channels.at("G") == std::vector<float>{2, 5});
    CHECK(image.channels.at("N.Z") == std::vector<float>{1, 0});
    CHECK(image.rgb() == colour);
    CHECK(image.rgb("N", "XYZ") == normal);
    image.name = "picture.exr";
    expectError(ExitCode::BadData, "picture.exr: has no channel Albedo.R", [&] { image.rgb("Albedo"); });
    image.channels["B"].pop_back();
    expectError(ExitCode::BadData, "channel B", [&] { image.rgb(); });
}

TEST_CASE("half and unsigned channels and a shifted data window become floats") {
    const TemporaryFolder folder;
    writeMixedTypes(folder / "mixed.exr");
    const LayeredImage image = readExr(folder / "mixed.exr");
    CHECK(image.width == 4);
    CHECK(image.height == 4);
    CHECK(image.channels.at("H")[4 * 3 + 2] == 3.5f);
    CHECK(image.channels.at("U")[4 * 1 + 3] == 300001.0f);
}

TEST_CASE("what is no usable EXR is refused by name") {
    const TemporaryFolder folder;
    expectError(ExitCode::NotFound, "missing.exr", [&] { readExr(folder / "missing.exr"); });
    expectError(ExitCode::Io, "not a regular file", [&] { readExr(folder / ""); });

    folder.write("empty.exr", {});
    expectError(ExitCode::BadData, "empty.exr", [&] { readExr(folder / "empty.exr"); });
    folder.write("text.exr", bytesOf("# a text that was called an EXR, long enough to be read as a header"));
    expectError(ExitCode::BadData, "text.exr", [&] { readExr(folder / "text.exr"); });

    writeMixedTypes(folder / "subsampled.exr", 2);
    expectError(ExitCode::BadData, "channel H is subsampled", [&] { readExr(folder / "subsampled.exr"); });
}

TEST_CASE("an EXR cut short anywhere is refused") {
    const TemporaryFolder folder;
    writeExr(folder / "whole.exr", noiseImage(16, 40));
    const auto whole = folder.read("whole.exr");
    for (size_t length = 0; length < whole.size(); length += 1 + whole.size() / 60) {
        INFO("cut at " << length << " of " << whole.size());
        folder.write("cut.exr", std::span(whole).first(length));
        expectError(ExitCode::BadData, "cut.exr", [&] { readExr(folder / "cut.exr"); });
    }
}

TEST_CASE("an EXR that claims an absurd size is refused before it costs memory") {
    const TemporaryFolder folder;
    writeExr(folder / "small.exr", noiseImage(16, 16));
    const auto small = folder.read("small.exr");
    const std::pair<int32_t, int32_t> corners[] = {{(1 << 29) - 1, 15},
                                                   {15, (1 << 29) - 1},
                                                   {(1 << 20) - 1, (1 << 20) - 1},
                                                   {0x7ffffffe, 0x7ffffffe},
                                                   {-1, -1},
                                                   {16383, 16383}};
    for (const auto& [maxX, maxY] : corners) {
        INFO(maxX << ", " << maxY);
        auto bytes = small;
        claimSize(bytes, maxX, maxY);
        folder.write("absurd.exr", bytes);
        expectError(ExitCode::BadData, "absurd.exr", [&] { readExr(folder / "absurd.exr"); });
    }
}

TEST_CASE("a damaged EXR is read or refused, nothing else") {
    const TemporaryFolder folder;
    writeExr(folder / "whole.exr", noiseImage(16, 16));
    const auto whole = folder.read("whole.exr");
    std::mt19937 random(3);
    int refused = 0;
    for (int trial = 0; trial < 400; ++trial) {
        auto bytes = whole;
        // Half of the trials in the header, where the structure is.
        const size_t range = trial % 2 ? bytes.size() : std::min<size_t>(bytes.size(), 400);
        for (int k = 0; k < 3; ++k) bytes[random() % range] = static_cast<uint8_t>(random());
        folder.write("damaged.exr", bytes);
        try {
            readExr(folder / "damaged.exr");
        } catch (const Error& error) {
            CHECK(error.code() == ExitCode::BadData);
            ++refused;
        }
    }
    CHECK(refused > 100);
}

TEST_CASE("a file appears whole or not at all") {
    const TemporaryFolder folder;
    const auto old = bytesOf("the old file");
    folder.write("out.exr", old);

    SECTION("success replaces it and leaves no temporary") {
        writeExr(folder / "out.exr", noiseImage(8, 8));
        CHECK(readExr(folder / "out.exr").width == 8);
        CHECK(folder.entries() == 1);
    }
    SECTION("a full disk leaves the old one") {
        // A limit on the size of files stands in for the disk; EFBIG comes instead of a signal.
        const auto oldHandler = std::signal(SIGXFSZ, SIG_IGN);
        rlimit before{};
        REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
        rlimit small = before;
        small.rlim_cur = 8192;
        REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
        const std::vector<uint8_t> many(100000, 1);
        expectError(ExitCode::Io, "out.exr", [&] { writeExr(folder / "out.exr", noiseImage(64, 64)); });
        // Small enough to stay in a buffer until the end.
        expectError(ExitCode::Io, "out.exr", [&] { writeFileAtomically(folder / "out.exr", many); });
        setrlimit(RLIMIT_FSIZE, &before);
        std::signal(SIGXFSZ, oldHandler);
        CHECK(folder.read("out.exr") == old);
        CHECK(folder.entries() == 1);
    }
    SECTION("an image that cannot be written leaves the old one") {
        LayeredImage image = noiseImage(8, 8);
        image.channels["R"].pop_back();
        expectError(ExitCode::Internal, "channel R", [&] { writeExr(folder / "out.exr", image); });
        image = noiseImage(8, 8);
        image.attributes["channels"] = "a name OpenEXR keeps for itself";
        expectError(ExitCode::Internal, "out.exr", [&] { writeExr(folder / "out.exr", image); });
        CHECK(folder.read("out.exr") == old);
        CHECK(folder.entries() == 1);
    }
}

TEST_CASE("targets that cannot be replaced are refused by name") {
    const TemporaryFolder folder;
    const std::vector<uint8_t> bytes(10);
    expectError(ExitCode::Io, "nowhere", [&] { writeFileAtomically(folder / "nowhere/a.bin", bytes); });
    expectError(ExitCode::Io, "is a folder", [&] { writeFileAtomically(folder / "", bytes); });
    expectError(ExitCode::Io, "not a regular file", [&] { writeFileAtomically("/dev/null", bytes); });
    // What is open elsewhere would be replaced under its writer, also where it is a regular file.
    expectError(ExitCode::Io, "not a regular file", [&] { writeFileAtomically("/dev/fd/0", bytes); });
    CHECK(std::filesystem::is_character_file("/dev/null"));
    expectError(ExitCode::Io, "nowhere", [&] { requireWritable(folder / "nowhere/a.bin"); });
    requireWritable(folder / "a.bin");
    CHECK(folder.entries() == 0);
}

TEST_CASE("a symbolic link stays one") {
    const TemporaryFolder folder;
    folder.write("real.bin", bytesOf("old"));
    std::filesystem::create_symlink("real.bin", folder / "link.bin");
    const auto bytes = bytesOf("new");
    writeFileAtomically(folder / "link.bin", bytes);
    CHECK(std::filesystem::is_symlink(folder / "link.bin"));
    CHECK(folder.read("real.bin") == bytes);
}

// ---- Radiance HDR

namespace {

const std::string kHdrHeader = "#?RADIANCE\n# comment\nFORMAT=32-bit_rle_rgbe\n\n";

std::vector<uint8_t> hdr(const std::string& size, std::vector<uint8_t> pixels) {
    auto bytes = bytesOf(kHdrHeader + size + "\n");
    bytes.insert(bytes.end(), pixels.begin(), pixels.end());
    return bytes;
}

// Nine pixels: red 128 nine times, green 0 ... 8, blue 64 once and 32 eight times, exponent 129 (scale 2^-7).
const std::vector<uint8_t> kComponentRuns{2, 2, 0, 9, 128 + 9, 128, 9,  0,       1,  2,       3,
                                          4, 5, 6, 7, 8,       1,   64, 128 + 8, 32, 128 + 9, 129};

LayeredImage readHdrBytes(const TemporaryFolder& folder, const std::vector<uint8_t>& bytes) {
    return readHdr(folder.write("sky.hdr", bytes));
}

} // namespace

TEST_CASE("an HDR with plain pixels") {
    const TemporaryFolder folder;
    // mantissa * 2^(exponent - 136); a zero exponent is black whatever the mantissas are
    const LayeredImage image = readHdrBytes(
        folder, hdr("-Y 2 +X 2", {128, 64, 0, 129, 255, 255, 255, 0, 1, 2, 3, 136, 200, 100, 50, 128}));
    CHECK(image.width == 2);
    CHECK(image.height == 2);
    CHECK(image.rgb() ==
          std::vector<glm::vec3>{{1, 0.5f, 0}, {0, 0, 0}, {1, 2, 3}, {200 / 256.f, 100 / 256.f, 50 / 256.f}});
}

TEST_CASE("an HDR with runs by component") {
    const TemporaryFolder folder;
    const LayeredImage image = readHdrBytes(folder, hdr("-Y 1 +X 9", kComponentRuns));
    for (size_t x = 0; x < 9; ++x) {
        CHECK(image.channels.at("R")[x] == 1.0f);
        CHECK(image.channels.at("G")[x] == static_cast<float>(x) / 128);
        CHECK(image.channels.at("B")[x] == (x == 0 ? 0.5f : 0.25f));
    }
}

TEST_CASE("an HDR with runs of pixels") {
    const TemporaryFolder folder;
    // 1 pixel, 3 more of it, another, then 2 + 1 * 256 more of that one
    const LayeredImage image = readHdrBytes(
        folder, hdr("-Y 1 +X 263", {128, 0, 0, 129, 1, 1, 1, 3, 0, 128, 0, 129, 1, 1, 1, 2, 1, 1, 1, 1}));
    const auto& red = image.channels.at("R");
    CHECK(std::ranges::count(red, 1.0f) == 4);
    CHECK(std::all_of(red.begin(), red.begin() + 4, [](float v) { return v == 1; }));
    CHECK(std::ranges::count(image.channels.at("G"), 1.0f) == 259);
}

TEST_CASE("what is no usable HDR is refused by name") {
    const TemporaryFolder folder;
    const auto refuse = [&](const std::string& thing, const std::vector<uint8_t>& bytes) {
        INFO(thing);
        expectError(ExitCode::BadData, "sky.hdr: " + thing, [&] { readHdrBytes(folder, bytes); });
    };
    refuse("not a Radiance HDR", {});
    refuse("not a Radiance HDR", bytesOf("P6\n1 1\n"));
    refuse("damaged HDR: the data end", bytesOf("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"));
    refuse("not a usable HDR: endless header", bytesOf("#?RADIANCE\n" + std::string(100000, 'x')));
    refuse("HDR format 32-bit_rle_xyze", bytesOf("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n"));
    refuse("HDR size line \"+X 4 -Y 4\"", hdr("+X 4 -Y 4", {}));
    refuse("HDR size line \"-Y 4 +X 4 5\"", hdr("-Y 4 +X 4 5", {}));
    refuse("the picture is empty", hdr("-Y -4 +X 4", {}));
    refuse("the picture is empty", hdr("-Y 0 +X 4", {}));
    refuse("999999999 x 999999999 pixels", hdr("-Y 999999999 +X 999999999", {}));
    refuse("damaged HDR: the data end", hdr("-Y 16384 +X 16384", {1, 2, 3, 4}));
    refuse("damaged HDR: a scanline of 8 pixels", hdr("-Y 1 +X 9", {2, 2, 0, 8}));
    refuse("damaged HDR: a run", hdr("-Y 1 +X 9", {2, 2, 0, 9, 128 + 10, 1}));
    refuse("damaged HDR: a run", hdr("-Y 1 +X 9", {2, 2, 0, 9, 0, 1}));
    refuse("damaged HDR: a run", hdr("-Y 1 +X 4", {1, 1, 1, 2}));
    refuse("damaged HDR: a run", hdr("-Y 1 +X 4", {9, 9, 9, 9, 1, 1, 1, 4}));
    refuse("damaged HDR: a run",
           hdr("-Y 1 +X 4", {9, 9, 9, 9, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1}));
    expectError(ExitCode::NotFound, "none.hdr", [&] { readHdr(folder / "none.hdr"); });
}

TEST_CASE("an HDR cut short anywhere is refused") {
    const TemporaryFolder folder;
    const auto whole = hdr("-Y 1 +X 9", kComponentRuns);
    for (size_t length = 0; length < whole.size(); ++length) {
        const std::vector<uint8_t> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
        expectError(ExitCode::BadData, "sky.hdr", [&] { readHdrBytes(folder, cut); });
    }
}
