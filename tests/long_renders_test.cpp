// Nothing grows with the number of frames: neither the memory that the process holds nor its mappings.
// IRRADIA_FULL=1 renders 10,000 frames, else 600.
#include "engine/scene/load_scene.h"
#include "tests/support/cached_scene.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <fstream>
#include <functional>

using namespace irradia;
using namespace irradia::test;

namespace {

struct Footprint {
    int64_t kilobytes = 0, mappings = 0;
};

Footprint footprint() {
    Footprint now;
    std::string word;
    for (std::ifstream status("/proc/self/status"); status >> word;)
        if (word == "VmRSS:") status >> now.kilobytes;
    std::string line;
    for (std::ifstream maps("/proc/self/maps"); std::getline(maps, line);) ++now.mappings;
    return now;
}

// The first fifth makes what is kept.
void checkNoGrowth(const std::function<void(uint32_t index)>& renderFrame) {
    const bool full = std::getenv("IRRADIA_FULL") != nullptr;
    const uint32_t frames = full ? 10000 : 600;
    // The allocator's own coming and going, which a few hundred frames do not see the end of (once 3 MB): of
    // 10,000 frames far below a record, a view or a descriptor set a frame.
    const int64_t allowed = full ? 2048 : 8192;
    Footprint before;
    for (uint32_t i = 0; i < frames; ++i) {
        if (i == frames / 5) before = footprint();
        renderFrame(i);
    }
    const Footprint after = footprint();
    INFO(before.kilobytes << " kB, " << before.mappings << " mappings; then " << after.kilobytes << " kB, "
                          << after.mappings);
    CHECK(after.kilobytes - before.kilobytes < allowed);
    CHECK(after.mappings - before.mappings < 16);
}

} // namespace

TEST_CASE("many frames by path tracing and with a cache hold no more than some") {
    Device device; // without validation, which keeps records of its own
    const Scene scene = loadScene(IRRADIA_BIN_DIR "/../scenes/cornell-box.glb");
    const Camera& camera = scene.cameras.at(0);
    const GpuScene gpu = uploaded(device, scene);
    Profiler profiler;
    NrcOptions options;
    options.paths.width = options.paths.height = 32;
    options.config = nrcPreset("balanced");

    WavefrontPathTracer tracer(device, gpu, options.paths, &profiler);
    checkNoGrowth([&](uint32_t i) {
        tracer.renderFrame(camera, i);
        profiler.endFrame(1.0);
    });
    NrcRenderer renderer(device, gpu, sceneBounds(scene), options, &profiler);
    checkNoGrowth([&](uint32_t i) {
        renderer.renderFrame(camera, i);
        profiler.endFrame(1.0);
    });
}
