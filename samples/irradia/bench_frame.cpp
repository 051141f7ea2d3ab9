// irradia bench frame: the time of each pass of a frame, median and p90.
#include "commands.h"
#include "engine/error.h"
#include "frame_stats.h"
#include <iostream>

namespace irradia {

namespace {

struct BenchFrameOptions {
    RenderRequest request;
    uint32_t frames = 16;
    std::string json;
};

void benchFrame(const BenchFrameOptions& options) {
    RenderSession session(options.request);
    // The first frames compile the kernels.
    for (uint32_t i = 0; i < 2; ++i) session.renderFrame(i);
    session.profiler().reset();
    for (uint32_t i = 0; i < options.frames; ++i) session.renderFrame(2 + i);
    printFrameStats(session);
    if (options.json.empty()) return;
    const std::string text = frameStats(session).dump(2) + "\n";
    if (options.json == "-")
        std::cout << text;
    else
        writeFileAtomically(options.json,
                            std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

} // namespace

void addBenchFrame(CLI::App& bench) {
    auto options = std::make_shared<BenchFrameOptions>();
    options->request.size = "256x256";
    CLI::App* command = bench.add_subcommand("frame", "Time of every pass of a frame, median and p90");
    addRequestOptions(*command, options->request);
    command->add_option("--frames", options->frames, "Frames to time, after two that are not")
        ->check(CLI::Range(1u, 100000u))
        ->capture_default_str();
    command->add_option("--json", options->json, "File for the numbers, - for stdout");
    command->callback([options] { benchFrame(*options); });
}

} // namespace irradia
