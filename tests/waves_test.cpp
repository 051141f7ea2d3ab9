// How a frame's paths are cut into waves: each sample of each pixel once, in order, aligned, and no wave larger
// than what its buffers were made for.
#include "engine/path/wave.h"
#include "tests/reference/random.h"
#include <catch2/catch_test_macros.hpp>
#include <vector>

using namespace irradia;
using reference::Random;

namespace {

uint32_t below(Random& random, uint32_t end) {
    return static_cast<uint32_t>(random.uniform() * end);
}

// What is wrong with the waves of such a frame, empty if nothing.
std::string faultOf(uint32_t first, uint32_t pixels, uint32_t samples, uint32_t most) {
    const uint32_t room = Waves::pathsOfWave(pixels, samples, most);
    std::vector<uint32_t> done(pixels, 0); // samples
    for (Waves waves(first, pixels, samples, room); const auto wave = waves.next();) {
        if (wave->paths() > room) return "a wave is larger than its buffers";
        if ((wave->firstPixel - first) % Waves::kPixelAlignment != 0) return "a wave is not aligned";
        for (uint32_t i = 0; i < wave->pixels; ++i) {
            uint32_t& of = done.at(wave->firstPixel - first + i);
            if (of != wave->firstSample) return "samples are not in order";
            of += 1u << wave->log2Samples;
            if ((of == samples) != wave->isLast) return "another wave than the last says it is";
        }
    }
    for (const uint32_t of : done)
        if (of != samples) return "a pixel has another number of samples";
    return "";
}

} // namespace

TEST_CASE("each sample of each pixel is in one wave, in order, whatever the sizes") {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const uint32_t pixels = 1 + below(random, 1u << below(random, 14));
        const uint32_t samples = 1 + below(random, 1u << below(random, 9));
        const uint32_t most = 1 + below(random, 1u << below(random, 15));
        INFO(pixels << " pixels, " << samples << " samples, waves of " << most);
        CHECK(faultOf(0, pixels, samples, most) == "");
        CHECK(faultOf(gpu::kFirstSurfacePath, pixels, samples, most) == "");
    }
}

TEST_CASE("few pixels have many samples in flight, many pixels one") {
    CHECK(Waves(0, 256, 65536, 1u << 15).next()->log2Samples == 7);
    CHECK(Waves(0, 256, 100, 1u << 15).next()->log2Samples == 6); // 64, then 32 and 4
    CHECK(Waves(0, 1920 * 1080, 64, 1u << 15).next()->log2Samples == 0);
    CHECK(Waves(0, 1920 * 1080, 64, 1u << 15).next()->paths() == 1u << 15);
    CHECK_FALSE(Waves(0, 0, 1, 1u << 15).next());
}
