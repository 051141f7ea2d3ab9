// irradia render: headless frames into an EXR or a PNG, and what else is asked for.
#include "commands.h"
#include "engine/error.h"
#include "frame_stats.h"
#include "methods.h"
#include "render_frames.h"
#include "render_outputs.h"
#include "request_options.h"
#include "samples/support/interrupt.h"
#include "samples/support/numbers.h"
#include "samples/support/progress.h"
#include <fmt/ranges.h>

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

constexpr uint32_t kMostWarmup = 1'000'000;

FramePlan planFrames(const RenderOptions& options) {
    FramePlan plan = parseFrames(options.frames.empty() ? "1" : options.frames);
    if (options.seconds > 0.0) {
        plan.seconds = options.seconds;
        if (options.frames.empty()) plan.end = UINT32_MAX;
    }
    plan.warmup = options.warmup.value_or(findMethod(options.request.method).warmup);
    requireOwnSamples(plan, options.request.samplesPerFrame);
    return plan;
}

// The first line of the log: what will be done, defaults included.
std::string headingOf(const RenderOptions& options, const FramePlan& plan) {
    const RenderRequest& request = options.request;
    std::string text = "render: method " + request.method;
    for (const MethodOption& option : findMethod(request.method).options)
        if (const std::string& value = valueOf(request.methodOptions, option); !value.empty())
            text += fmt::format(", {} {}", option.name, value);
    text += fmt::format(", warm-up {}", plan.warmup);
    if (plan.end != UINT32_MAX) text += fmt::format(", frames {}-{}", plan.first, plan.end);
    if (std::isfinite(plan.seconds)) text += fmt::format(", time {:g} s", plan.seconds);
    return text + fmt::format(", size {}", sizeText(request.size));
}

void render(RenderOptions options) {
    const FramePlan plan = planFrames(options);
    options.request.heading = headingOf(options, plan);
    options.request.firstFrame = plan.first;
    if (plan.end != UINT32_MAX) options.request.endFrame = plan.end;
    options.outputs.check(options.request);
    catchInterrupts();
    options.request.betweenSteps = stopIfInterrupted;
    RenderSession session(options.request);
    requireApart(options.outputs.files(), session.inputs());
    const RenderedFrames run = renderFrames(session, plan, options.progress, !options.outputs.stats.empty());

    writeOutputs(options.outputs, session, plan, run);
    printFrameStats(session);
    if (session.device().validationMessages() > 0)
        fail(ExitCode::Internal, "{} validation messages", session.device().validationMessages());
    endIfInterrupted(run.end - run.first, "frames");
}

// "0 of pt, 64 of nrc, ..."
std::string warmups() {
    std::vector<std::string> texts;
    for (const std::string& name : methodNames())
        texts.push_back(fmt::format("{} of {}", findMethod(name).warmup, name));
    return fmt::format("{}", fmt::join(texts, ", "));
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
        ->default_str("the method's: " + warmups());
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
    command->get_option("--method")
        ->default_str(fmt::format("{}; {} where --max-bounces 0 leaves nothing to a cache",
                                  usualMethod(1).name, usualMethod(0).name));
    options->outputs.addOptions(*command);
    command->add_flag("--aov", options->request.layers, "Add albedo, normal, position and depth layers")
        ->group("Output");
    addFrameOptions(*command, *options);
    addProgressOption(*command, options->progress);
    command->callback([options, command] {
        options->request.method =
            chooseMethod(options->request.method, options->request.maxBounces, *command);
        requireOptionsOf(options->request.method, *command);
        render(*options);
    });
}

} // namespace irradia
