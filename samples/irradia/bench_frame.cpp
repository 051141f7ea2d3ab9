// irradia bench frame: the time of each pass of a frame, median and p90.
#include "bench_tools.h"
#include "commands.h"
#include "engine/error.h"
#include "frame_stats.h"
#include "methods.h"
#include "request_options.h"
#include "samples/support/interrupt.h"
#include "samples/support/numbers.h"
#include "samples/support/outputs.h"

namespace irradia {

namespace {

struct BenchFrameOptions {
    RenderRequest request;
    uint32_t frames = 16;
    std::string json;
};

void benchFrame(BenchFrameOptions options) {
    checkOutputs({{"--json", options.json}}, inputFiles(options.request));
    catchInterrupts();
    options.request.betweenSteps = stopIfInterrupted;
    RenderSession session(options.request);
    requireApart({{"--json", options.json}}, session.inputs());
    // Frames of a warm-up ask the cache before it knows anything, as all do later. The first compile the
    // kernels.
    for (uint32_t i = 0; i < 2; ++i) session.renderWarmupFrame(i);
    session.profiler().reset();
    stopIfInterrupted();
    uint32_t frames = 0;
    while (frames < options.frames && !interruptedBy()) session.renderWarmupFrame(2 + frames++);
    printFrameStats(session);
    if (!options.json.empty()) writeJson(options.json, frameStats(session));
    endIfInterrupted(frames, "frames");
}

} // namespace

void addBenchFrame(CLI::App& bench) {
    auto options = std::make_shared<BenchFrameOptions>();
    options->request.size = {256, 256};
    CLI::App* command = bench.add_subcommand("frame", "Time of every pass of a frame, median and p90");
    addRequestOptions(*command, options->request);
    addWhole(*command, "--frames", options->frames, "Frames to time, after two that are not", 1, 100000)
        ->capture_default_str();
    addOutput(*command, "--json", options->json, "File for the numbers, - for stdout");
    command->callback([options, command] {
        requireOptionsOf(options->request.method, *command);
        benchFrame(*options);
    });
}

} // namespace irradia
