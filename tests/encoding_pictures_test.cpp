// Encodings by what one sees of them: the project's picture, learned in equal
// steps, by FLIP.
#include "engine/image/image.h"
#include "engine/image/metrics.h"
#include "tests/support/temporary_folder.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>

using namespace irradia;
using irradia::test::TemporaryFolder;

namespace {

constexpr const char* kPicture = "picture.png";

void fitImage(const TemporaryFolder& folder, const std::string& arguments) {
    const std::string command = "cd " + (folder / "").string() + " && " IRRADIA_BIN_DIR "/fit_image " +
                                arguments + " >stdout.txt 2>stderr.txt";
    INFO(command);
    REQUIRE(std::system(command.c_str()) == 0);
}

// The curve of IEC 61966-2-1.
float decoded(uint8_t byte) {
    const float encoded = static_cast<float>(byte) / 255.0f;
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

std::vector<glm::vec3> light(const Rgba8Image& image) {
    std::vector<glm::vec3> colours;
    for (size_t i = 0; i < image.pixels.size(); i += 4)
        colours.emplace_back(decoded(image.pixels[i]), decoded(image.pixels[i + 1]),
                             decoded(image.pixels[i + 2]));
    return colours;
}

double flipOf(const TemporaryFolder& folder, const std::string& network) {
    fitImage(folder, std::string(kPicture) +
                         " -o learned.exr --steps 200 --batch 1024 "
                         "--progress none --network " IRRADIA_SOURCE_DIR "/samples/fit_image/networks/" +
                         network + ".json");
    const LayeredImage learned = readExr(folder / "learned.exr");
    const Rgba8Image picture = decodeImage(folder.read(kPicture), kPicture);
    return compareImages(learned.width, learned.height, learned.rgb(), light(picture)).flip;
}

} // namespace

TEST_CASE("a grid's picture looks more like it than those of waves, and these "
          "more than that of bare coordinates") {
    const TemporaryFolder folder;
    fitImage(folder, std::string("--make-picture ") + kPicture + " --size 64x64");
    const double grid = flipOf(folder, "hash_grid"), waves = flipOf(folder, "frequency"),
                 identity = flipOf(folder, "identity");
    INFO("FLIP: hash grid " << grid << ", frequency " << waves << ", identity " << identity);
    CHECK(2.0 * grid < waves);
    CHECK(waves < identity);
}
