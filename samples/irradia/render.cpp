// irradia render: headless frames into an EXR or a PNG, and what else is asked for.
#include "commands.h"
#include "engine/error.h"
#include "frame_stats.h"
#include "methods.h"
#include "render_frames.h"
#include "render_outputs.h"
#include "samples/support/interrupt.h"
#include "samples/support/numbers.h"
#include "samples/support/progress.h"

namespace irradia {

namespace {

struct RenderOptions {
    RenderRequest request;
    RenderOutputs outputs;
    std::string frames;   // empty: one, or as many as there is time for
    double seconds = 0.0; // 0: any
    std::optional<uint32_t> warmup;
    std::string progress = "auto";
};

constexpr uint32_t kCacheWarmup = 64;
constexpr uint32_t kMostWarmup = 1'000'000;

// What is indirect, the cache is asked for; without it there is nothing to ask, unless it is asked for by
// name.
std::string chooseMethod(const RenderRequest& request, const CLI::App& command) {
    if (!request.method.empty()) return request.method;
    return request.maxBounces == 0 && optionOfCaches(command).empty() ? "pt" : "nrc";
}

FramePlan planFrames(const RenderOptions& options) {
    FramePlan plan = parseFrames(options.frames.empty() ? "1" : options.frames);
    if (options.seconds > 0.0) {
        plan.seconds = options.seconds;
        if (options.frames.empty()) plan.end = UINT32_MAX;
    }
    plan.warmup = options.warmup.value_or(methodHasCache(options.request.method) ? kCacheWarmup : 0);
    requireOwnSamples(plan, options.request.samplesPerFrame);
    return plan;
}

// The first line of the log: what will be done, defaults included.
std::string headingOf(const RenderOptions& options, const FramePlan& plan) {
    const RenderRequest& request = options.request;
    std::string text = "render: method " + request.method;
    if (methodHasCache(request.method)) text += fmt::format(", preset {}", request.preset);
    text += fmt::format(", warm-up {}", plan.warmup);
    if (plan.end != UINT32_MAX) text += fmt::format(", frames {}-{}", plan.first, plan.end);
    if (std::isfinite(plan.seconds)) text += fmt::format(", time {:g} s", plan.seconds);
    return text + fmt::format(", size {}", request.size);
}

void render(RenderOptions options) {
    const FramePlan plan = planFrames(options);
    options.request.heading = headingOf(options, plan);
    options.request.firstFrame = plan.first;
    if (plan.end != UINT32_MAX) options.request.endFrame = plan.end;
    options.outputs.check(options.request);
    catchInterrupts();
    RenderSession session(options.request);
    requireApart(options.outputs.files(), session.inputs());
    const RenderedFrames run = renderFrames(session, plan, options.progress, !options.outputs.stats.empty());

    writeOutputs(options.outputs, session, plan, run);
    printFrameStats(session);
    if (session.device().validationMessages() > 0)
        fail(ExitCode::Internal, "{} validation messages", session.device().validationMessages());
    endIfInterrupted(run.end - run.first, "frames");
}

void addFrameOptions(CLI::App& command, RenderOptions& options) {
    command.add_option("--frames", options.frames, "N frames, or the half-open range A-B")
        ->type_name("N|A-B")
        ->group("Frames")
        ->default_str("1, or what --time allows");
    addSeconds(command, "--time", options.seconds,
               "To render for, warm-up included; at least one frame, and with --frames no more than those")
        ->group("Frames");
    const CLI::callback_t readWarmup = [&options](const CLI::results_t& texts) {
        options.warmup = toWhole(texts.back(), 0, kMostWarmup);
        if (!options.warmup)
            fail(ExitCode::Usage, "--warmup {}: not a whole number from 0 to {}", texts.back(), kMostWarmup);
        return true;
    };
    command
        .add_option("--warmup", readWarmup,
                    "Frames before these, which train but are not averaged; half of --time at most")
        ->type_name("N")
        ->group("Frames")
        ->default_str(fmt::format("{}, 0 for pt", kCacheWarmup));
    command
        .add_option(
            "--changes", options.request.changes,
            "JSON list of changes: {\"frame\": k} and any of \"emissive_strength\": {\"material\", "
            "\"value\"}, \"material\": {\"name\", \"base_color\", \"roughness\", \"metallic\"}, "
            "\"environment\": [r,g,b] or a factor, \"camera\": {...}, \"restart\": true (of the film); "
            "frames are numbered as by --frames, and warm-up sees the scene of the first; with --frames a "
            "change beyond the last is an error")
        ->group("Frames");
}

} // namespace

void addRender(CLI::App& program) {
    auto options = std::make_shared<RenderOptions>();
    options->request.method.clear();
    CLI::App* command = program.add_subcommand("render", "Render frames of a scene, headless");
    addRequestOptions(*command, options->request);
    command->get_option("--method")->default_str("nrc; pt where --max-bounces 0 leaves nothing to the cache");
    options->outputs.addOptions(*command);
    command->add_flag("--aov", options->request.surfaces, "Add albedo, normal, position and depth layers")
        ->group("Output");
    addFrameOptions(*command, *options);
    addProgressOption(*command, options->progress);
    command->callback([options, command] {
        options->request.method = chooseMethod(options->request, *command);
        requireOptionsOf(options->request.method, *command);
        render(*options);
    });
}

} // namespace irradia
