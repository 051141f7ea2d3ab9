// The program that puts pictures into one: figures side by side, and references as means of parts; and that
// the reference in the repository is of the scene as it is today.
#include "engine/image/decode.h"
#include "engine/image/image.h"
#include "engine/scene/load_scene.h"
#include "tests/reference/z_test.h"
#include "tests/support/gpu_render.h"
#include "tests/support/temporary_folder.h"
#include <ImfChannelList.h>
#include <ImfRgbaFile.h>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <sys/wait.h>

using namespace irradia;
using irradia::test::TemporaryFolder;

namespace {

// In the folder, so that arguments name files in it; returns the exit code.
int run(const TemporaryFolder& folder, const std::string& command) {
    const std::string line =
        "cd " + (folder / "").string() + " && " IRRADIA_BIN_DIR "/" + command + " >out.txt 2>err.txt";
    const int status = std::system(line.c_str());
    REQUIRE(WIFEXITED(status));
    return WEXITSTATUS(status);
}

std::string errors(const TemporaryFolder& folder) {
    const std::vector<uint8_t> bytes = folder.read("err.txt");
    return {bytes.begin(), bytes.end()};
}

void checkRefused(const TemporaryFolder& folder, const std::string& arguments, int code,
                  const std::string& named) {
    INFO(arguments);
    CHECK(run(folder, "pictures " + arguments) == code);
    INFO(errors(folder));
    CHECK(errors(folder).starts_with("pictures: "));
    CHECK(errors(folder).find(named) != std::string::npos);
}

// Two pixels wide, one high.
void writePair(const TemporaryFolder& folder, const std::string& name, const glm::vec3& left,
               const glm::vec3& right, const std::string& frames = "0-8") {
    LayeredImage image;
    image.width = 2;
    image.height = 1;
    image.setRgb("", std::array{left, right});
    image.attributes = {{"irradia.frames", frames}, {"irradia.seed", "20"}};
    writeExr(folder / name, image);
}

std::array<int, 3> pixel(const Rgba8Image& image, int x, int y) {
    const auto at = image.pixels.begin() + 4 * (y * image.width + x);
    return {at[0], at[1], at[2]};
}

using Colour = std::array<int, 3>;
constexpr Colour kWhite{255, 255, 255};

} // namespace

TEST_CASE("a row shows each picture as a screen does, pixels enlarged, white between") {
    const TemporaryFolder folder;
    writePair(folder, "a.exr", {1, 0, 0}, {0, 0, 0});
    writePair(folder, "b.exr", {0, 1, 0}, {0.5f, 0.5f, 0.5f});
    REQUIRE(run(folder, "pictures row a.exr b.exr -o row.png --scale 3") == 0);
    const Rgba8Image row = decodeImage(folder.read("row.png"), "row.png");
    REQUIRE(row.width == 6 + 8 + 6);
    REQUIRE(row.height == 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) {
            CHECK(pixel(row, x, y) == Colour{255, 0, 0});
            CHECK(pixel(row, 3 + x, y) == Colour{0, 0, 0});
            CHECK(pixel(row, 14 + x, y) == Colour{0, 255, 0});
            CHECK(pixel(row, 17 + x, y) == Colour{188, 188, 188}); // sRGB of 0.5: 187.5
        }
    for (int y = 0; y < 3; ++y)
        for (int x = 6; x < 14; ++x) CHECK(pixel(row, x, y) == kWhite);
}

TEST_CASE("a mean counts every picture alike, in half floats, and says what it is of") {
    const TemporaryFolder folder;
    writePair(folder, "a.exr", {1, 2, 4}, {0, 0.25f, 60000}, "0-8");
    writePair(folder, "b.exr", {2, 4, 8}, {0, 0.25f, 60000}, "8-16");
    writePair(folder, "c.exr", {6, 0, 0}, {0, 0.25f, 60000}, "16-24");
    REQUIRE(run(folder, "pictures mean a.exr b.exr c.exr -o mean.exr") == 0);
    const LayeredImage mean = readExr(folder / "mean.exr");
    CHECK(mean.rgb() == std::vector<glm::vec3>{{3, 2, 4}, {0, 0.25f, 60000}});
    CHECK(mean.attributes.at("irradia.frames") == "0-8,8-16,16-24");
    CHECK(mean.attributes.at("irradia.seed") == "20");
    Imf::RgbaInputFile file((folder / "mean.exr").c_str());
    CHECK(file.header().channels().findChannel("R")->type == Imf::HALF);
}

TEST_CASE("noise is half of the squared difference, relative, with and without the largest hundredth") {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& name, float each, float last) {
        LayeredImage image;
        image.width = 100;
        image.height = 1;
        std::vector<glm::vec3> pixels(100, glm::vec3(each));
        pixels[3] = glm::vec3(last);
        image.setRgb("", pixels);
        writeExr(folder / name, image);
    };
    write("a.exr", 1.0f, 9.0f);
    write("b.exr", 0.5f, 1.0f);
    write("mean.exr", 0.7f, 0.7f);
    REQUIRE(run(folder, "pictures noise a.exr b.exr mean.exr") == 0);
    const std::vector<uint8_t> bytes = folder.read("out.txt");
    std::istringstream text(std::string(bytes.begin(), bytes.end()));
    double most = 0.0, all = 0.0;
    text >> most >> all;
    CHECK(std::abs(most - 0.25) < 1e-5); // 0.25 / 2 / (0.49 + 0.01)
    CHECK(std::abs(all - (99 * 0.25 + 64.0) / 100) < 1e-5);
    checkRefused(folder, "noise a.exr b.exr", 64, "pictures");
}

TEST_CASE("pictures that do not fit, names that would lose something and unknown words are refused") {
    const TemporaryFolder folder;
    writePair(folder, "a.exr", {1, 2, 4}, {0, 0, 1e6f});
    LayeredImage small;
    small.width = small.height = 1;
    small.setRgb("", std::array{glm::vec3(1)});
    writeExr(folder / "small.exr", small);

    checkRefused(folder, "row a.exr small.exr -o row.png", 65, "small.exr has 1 x 1 pixels");
    checkRefused(folder, "mean a.exr -o mean.exr", 65, "beyond half floats");
    checkRefused(folder, "row a.exr none.exr -o row.png", 66, "none.exr");
    checkRefused(folder, "row a.exr -o row.exr", 64, ".png");
    checkRefused(folder, "mean a.exr small.exr -o ./small.exr", 64, "would be lost");
    checkRefused(folder, "mean a.exr -o nowhere/mean.exr", 74, "nowhere");
    checkRefused(folder, "row a.exr -o row.png --scale 0", 64, "scale");
    checkRefused(folder, "column a.exr -o row.png", 64, "subcommand");
    checkRefused(folder, "", 64, "subcommand");
    CHECK(run(folder, "pictures --help") == 0);
    CHECK(run(folder, "pictures row --help") == 0);
    CHECK_FALSE(std::filesystem::exists(folder / "row.png"));
}

TEST_CASE("the stored reference shows the door room as it is rendered today") {
    const LayeredImage stored = readExr(IRRADIA_SOURCE_DIR "/samples/images/door-room.exr");
    REQUIRE(stored.width == 128);
    REQUIRE(stored.height == 128);
    reference::ImageEstimate reference{stored.width, stored.height, {}, {}};
    for (const glm::vec3& pixel : stored.rgb()) reference.mean.emplace_back(pixel);
    reference.variance.resize(reference.size()); // small beside the other's

    const Scene scene = loadScene(IRRADIA_BIN_DIR "/../scenes/door-room.glb");
    Device device;
    PathTracerOptions options;
    options.width = options.height = 128;
    options.maxBounces = 64;
    const FilmImage film =
        test::GpuRenderer(device, scene).render(chooseCamera(scene, "").camera, options, 96);
    const reference::ZTestResult result = reference::zTest(test::toEstimate(film), reference);
    INFO(result.summary());
    CHECK(result.meanRatioSigma < 0.01); // else a picture 5 % too bright would pass
    CHECK(std::abs(result.meanRatio - 1.0) < 4.0 * result.meanRatioSigma);
}
