// irradia render: headless frames into an EXR, and what else is asked for.
#include "commands.h"
#include "engine/error.h"
#include "frame_stats.h"
#include "render_session.h"
#include "samples/support/progress.h"
#include <chrono>

namespace irradia {

namespace {

struct RenderOptions {
    RenderRequest request;
    std::string output;
    std::string frames = "1";
    double seconds = 0.0;
    uint32_t warmup = 0;
    std::string png;
    std::string stats;
    std::string progress = "auto";
};

// Options of the design that later versions bring: known, and refused in one sentence.
constexpr const char* kLaterOptions[] = {"--model", "--at", "--camera-path", "--checkpoint"};
constexpr const char* kLaterFlags[] = {"--denoise", "--sequence", "--resume"};

struct FrameRange {
    uint32_t first = 0;
    uint32_t end = 0;
};

// "N" or half-open "A-B".
FrameRange parseFrames(const std::string& text) {
    unsigned a = 0, b = 0;
    int used = 0;
    if (std::sscanf(text.c_str(), "%9u-%9u%n", &a, &b, &used) == 2 && size_t(used) == text.size() && a < b)
        return {a, b};
    if (std::sscanf(text.c_str(), "%9u%n", &a, &used) == 1 && size_t(used) == text.size() && a > 0)
        return {0, a};
    fail(ExitCode::Usage, "--frames {}: not a number of frames from 1, nor a range A-B with A < B", text);
}

// Returns the number after the last frame's.
uint32_t renderFrames(RenderSession& session, const RenderOptions& options) {
    const FrameRange range = parseFrames(options.frames);
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    for (uint32_t i = 0; i < options.warmup; ++i) session.renderWarmupFrame(i);
    if (options.warmup > 0) session.endWarmup();
    ProgressMeter progress("render", options.progress);
    uint32_t frame = range.first;
    if (options.seconds > 0.0) {
        for (; elapsed() < options.seconds; ++frame) {
            session.renderFrame(frame);
            progress.update(std::min(elapsed() / options.seconds, 1.0));
        }
    } else {
        for (; frame < range.end; ++frame) {
            session.renderFrame(frame);
            progress.update(double(frame + 1 - range.first) / (range.end - range.first));
        }
    }
    progress.finish();
    return frame;
}

// Everything that decides the picture, so that it can be made again.
void describe(LayeredImage& image, RenderSession& session, uint32_t frames, uint32_t endFrame,
              uint32_t warmup) {
    const RenderRequest& request = session.request();
    auto& a = image.attributes;
    a["irradia.version"] = IRRADIA_VERSION;
    a["irradia.device"] = session.device().description().name;
    a["irradia.driver"] = session.device().description().driver;
    a["irradia.subgroupSize"] = std::to_string(session.device().subgroupSize());
    a["irradia.recordAccess"] = session.device().texelRecords() ? "texel" : "storage";
    a["irradia.scene"] = session.scene().name;
    a["irradia.sceneHash"] = fmt::format("{:016x}", session.scene().contentHash);
    a["irradia.method"] = request.method;
    a["irradia.seed"] = std::to_string(request.seed);
    a["irradia.frames"] = fmt::format("{}-{}", endFrame - frames, endFrame);
    a["irradia.options"] =
        fmt::format("--size {} --spp {} --max-bounces {} --camera '{}' --env '{}' --changes '{}' --view '{}' "
                    "--reference '{}'",
                    request.size, request.samplesPerFrame, request.maxBounces, request.camera,
                    request.environment, request.changes, request.view, request.reference);
    if (!session.nrc()) return;
    RadianceCache& cache = session.nrc()->cache();
    a["irradia.cache"] =
        fmt::format("--preset '{}' --network '{}' --warmup {}", request.preset, request.network, warmup);
    a["irradia.model"] = toJson(cache.trainer().config());
    a["irradia.trainingSteps"] = std::to_string(session.nrc()->counts().training.steps);
}

void render(const RenderOptions& options) {
    const FrameRange range = parseFrames(options.frames);
    RenderRequest request = options.request;
    request.firstFrame = range.first;
    if (options.seconds == 0.0) request.endFrame = range.end;
    for (const std::string& file : {options.output, options.png, options.stats})
        if (!file.empty()) requireWritable(file);
    RenderSession session(request);
    const uint32_t end = renderFrames(session, options);

    const FilmImage film = session.readFilm();
    LayeredImage image = toLayers(film);
    describe(image, session, film.frames, end, options.warmup);
    writeExr(options.output, image);
    if (!options.png.empty()) writePng(options.png, session.view().display(film));
    if (!options.stats.empty()) {
        const std::string text = frameStats(session).dump(2) + "\n";
        writeFileAtomically(options.stats,
                            std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
    }
    printFrameStats(session);
    if (session.device().validationMessages() > 0)
        fail(ExitCode::Internal, "{} validation messages", session.device().validationMessages());
    fmt::print("{}\n", options.output);
    if (!options.png.empty()) fmt::print("{}\n", options.png);
}

} // namespace

void addRender(CLI::App& program) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = program.add_subcommand("render", "Render frames of a scene, headless");
    addRequestOptions(*command, options->request);
    command->add_option("-o,--output", options->output, "EXR file")->required()->group("Output");
    command->add_option("--png", options->png, "The picture as a screen shows it")->group("Output");
    command->add_option("--stats", options->stats, "Times, rays and memory as JSON")->group("Output");
    command->add_flag("--aov", options->request.surfaces, "Add albedo, normal, position and depth layers")
        ->group("Output");
    command->add_option("--frames", options->frames, "N frames, or the half-open range A-B")
        ->group("Frames")
        ->capture_default_str();
    command->add_option("--time", options->seconds, "Seconds to render for, instead of a number of frames")
        ->check(CLI::PositiveNumber)
        ->group("Frames");
    command->add_option("--warmup", options->warmup, "Frames before these, which train but are not averaged")
        ->check(CLI::Range(0u, 1000000u))
        ->group("Frames")
        ->capture_default_str();
    command
        ->add_option(
            "--changes", options->request.changes,
            "JSON list of changes: {\"frame\": k} and any of \"emissive_strength\": {\"material\", "
            "\"value\"}, \"material\": {\"name\", \"base_color\", \"roughness\", \"metallic\"}, "
            "\"environment\": [r,g,b] or a factor, \"camera\": {...}, \"restart\": true (of the film); "
            "frames are numbered as by --frames, and warm-up sees the scene of the first; a change beyond "
            "the "
            "last is an error")
        ->group("Frames");
    addProgressOption(*command, options->progress);
    for (const char* name : kLaterOptions)
        command
            ->add_option_function<std::string>(
                name,
                [name](const std::string&) { fail(ExitCode::Usage, "{} comes in a later version", name); },
                "Comes in a later version")
            ->group("Later versions");
    for (const char* name : kLaterFlags)
        command
            ->add_flag_callback(
                name, [name] { fail(ExitCode::Usage, "{} comes in a later version", name); },
                "Comes in a later version")
            ->group("Later versions");
    command->callback([options] { render(*options); });
}

} // namespace irradia
