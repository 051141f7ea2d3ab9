#include "render_outputs.h"

#include "engine/error.h"
#include "engine/log.h"
#include "engine/scene/camera_matrices.h"
#include "frame_stats.h"
#include "methods.h"
#include "request_options.h"
#include "samples/session/kernel_form.h"
#include "samples/support/numbers.h"
#include "samples/support/standard_streams.h"
#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>
#include <functional>

namespace irradia {
namespace {

constexpr double kMostStops = 100.0;

// Stops, or nothing for "auto".
std::optional<double> parseExposure(const std::string& text) {
    if (text.empty()) return 0.0;
    if (text == "auto") return std::nullopt;
    const auto stops = toNumber(text.starts_with('+') ? text.substr(1) : text);
    if (!stops || std::abs(*stops) > kMostStops)
        fail(ExitCode::Usage, "--exposure {}: neither auto nor a number of stops from -{:g} to {:g}", text,
             kMostStops, kMostStops);
    return stops;
}

ToneMap parseToneMap(const std::string& text) {
    if (text.empty()) return ToneMap::Clip;
    const auto* found = std::ranges::find(kToneMapNames, text);
    if (found == std::end(kToneMapNames))
        fail(ExitCode::Usage, "--tonemap {} is unknown; there are {}", text, fmt::join(kToneMapNames, ", "));
    return static_cast<ToneMap>(found - std::begin(kToneMapNames));
}

// The automatic choice is made, and said.
DisplayOptions chooseDisplay(const RenderOutputs& outputs, const FilmImage& film) {
    const std::optional<double> stops = parseExposure(outputs.exposure);
    const DisplayOptions display{stops ? *stops : automaticExposure(film.mean),
                                 parseToneMap(outputs.toneMap)};
    if (!stops) logLine("exposure: {:+.2f} stops bring the median luminance to 0.18", display.exposure);
    return display;
}

// Everything that decides the picture, so that it can be made again.
void describe(LayeredImage& image, RenderSession& session, uint32_t frames, const FramePlan& plan,
              const RenderedFrames& run) {
    const RenderRequest& request = session.request();
    const float aspect = static_cast<float>(image.width) / static_cast<float>(image.height);
    image.matrices["worldToCamera"] = worldToCamera(session.camera(), session.scene().origin);
    image.matrices["worldToNDC"] = worldToNdc(session.camera(), aspect, session.scene().origin);
    auto& a = image.attributes;
    a["irradia.version"] = IRRADIA_VERSION;
    a["irradia.device"] = session.device().description().name;
    a["irradia.driver"] = session.device().description().driver;
    a["irradia.subgroupSize"] = std::to_string(session.device().subgroupSize());
    a["irradia.quadAccess"] = accessName(session.device());
    a["irradia.scene"] = session.scene().name;
    a["irradia.sceneHash"] = fmt::format("{:016x}", session.scene().contentHash);
    a["irradia.method"] = request.method;
    a["irradia.seed"] = std::to_string(request.seed);
    a["irradia.sampler"] = request.sampler;
    a["irradia.frames"] = fmt::format("{}-{}", run.end - frames, run.end);
    a["irradia.warmup"] = fmt::format("{} of {}", run.warmup, plan.warmup);
    a["irradia.endedBy"] = run.endedBy;
    a["irradia.options"] =
        fmt::format("--size {} --spp {} --max-bounces {} --camera '{}' --env '{}' --changes '{}' --view '{}' "
                    "--reference '{}'",
                    sizeText(request.size), request.samplesPerFrame, request.maxBounces, request.camera,
                    request.environment, request.changes, request.view, request.reference);
    if (!session.method().options.empty())
        a["irradia.methodOptions"] = optionsText(session.method(), request.methodOptions);
    for (const auto& [name, text] : session.attributes()) a["irradia." + name] = text;
}

// "A-B", or "A-" where only the time ends them.
std::string framesText(const FramePlan& plan) {
    return fmt::format("{}-{}", plan.first, plan.end == UINT32_MAX ? "" : std::to_string(plan.end));
}

nlohmann::ordered_json optionsOf(const RenderRequest& request, const FramePlan& plan,
                                 const DisplayOptions& display) {
    nlohmann::ordered_json options{{"scene", request.scene},
                                   {"method", request.method},
                                   {"size", sizeText(request.size)},
                                   {"spp", request.samplesPerFrame},
                                   {"max_bounces", request.maxBounces},
                                   {"seed", request.seed},
                                   {"sampler", request.sampler},
                                   {"frames", framesText(plan)},
                                   {"time", plan.seconds}, // null: any
                                   {"warmup", plan.warmup},
                                   {"camera", request.camera},
                                   {"env", request.environment},
                                   {"changes", request.changes},
                                   {"view", request.view},
                                   {"reference", request.reference},
                                   {"aov", request.layers},
                                   {"device", request.device.select},
                                   {"subgroup", request.device.subgroupSize},
                                   {"form", request.form},
                                   {"exposure", display.exposure},
                                   {"tonemap", kToneMapNames[static_cast<size_t>(display.toneMap)]}};
    for (const MethodOption& option : findMethod(request.method).options)
        options[option.name] = valueOf(request.methodOptions, option);
    return options;
}

nlohmann::ordered_json historyOf(const RenderedFrames& run) {
    auto rows = nlohmann::ordered_json::array();
    for (const FrameNote& note : run.history) {
        rows.push_back({{"frame", note.frame}, {"seconds", note.seconds}, {"mean", note.mean}});
        rows.back()["loss"] = note.loss ? nlohmann::ordered_json(*note.loss) : nullptr;
        rows.back()["records"] = note.records;
    }
    return rows;
}

void writeStats(const std::string& file, RenderSession& session, const FramePlan& plan,
                const RenderedFrames& run, const DisplayOptions& display) {
    nlohmann::ordered_json stats = frameStats(session);
    stats["warmup_frames"] = run.warmup;
    stats["frames_without_cache"] = session.statistics().framesWithoutCache;
    stats["seconds"] = run.seconds;
    stats["ended_by"] = run.endedBy;
    stats["history"] = historyOf(run);
    stats["options"] = optionsOf(session.request(), plan, display);
    const std::string text = stats.dump(2) + "\n";
    writeFileAtomically(file, std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

// Does all of it; throws the first error at the end.
void tryAll(const std::vector<std::function<void()>>& writes) {
    std::exception_ptr first;
    for (const auto& write : writes) try {
            write();
        } catch (...) {
            if (!first) first = std::current_exception();
        }
    if (first) std::rethrow_exception(first);
}

} // namespace

void RenderOutputs::addOptions(CLI::App& command) {
    addOutput(command, "-o,--output", output,
              "The picture: linear radiance as .exr, or as a screen shows it as .png")
        ->required()
        ->group("Output");
    addOutput(command, "--png", png, "The picture as a screen shows it")->group("Output");
    addOutput(command, "--stats", stats,
              "Times, rays, memory and options as JSON, and a row for frame 1, 2, 4, 8, ...")
        ->group("Output");
    command
        .add_option("--exposure", exposure,
                    "Of PNGs: stops, or auto, which brings the median luminance to a grey of 18 %")
        ->type_name("STOPS")
        ->group("Output")
        ->default_str("0");
    command
        .add_option(
            "--tonemap", toneMap,
            "Of PNGs: clip (what is above 1 is white), reinhard (L / (1 + L), Reinhard et al. 2002, eq. 3) "
            "or aces (Narkowicz 2015)")
        ->type_name("NAME")
        ->group("Output")
        ->default_str("clip");
}

std::vector<NamedFile> RenderOutputs::files() const {
    return {{"-o", output}, {"--png", png}, {"--stats", stats}};
}

std::vector<std::string> RenderOutputs::pngs() const {
    std::vector<std::string> all;
    if (hasEnding(output, ".png")) all.push_back(output);
    if (!png.empty()) all.push_back(png);
    return all;
}

void RenderOutputs::check(const RenderRequest& request) const {
    requireEnding({"-o", output}, {".exr", ".png"});
    requireEnding({"--png", png}, {".png"});
    for (const char* picture : {".exr", ".png"})
        if (hasEnding(stats, picture))
            fail(ExitCode::Usage, "--stats {}: is JSON, no {} file", stats, picture);
    parseExposure(exposure);
    parseToneMap(toneMap);
    for (const auto& [name, value] : {std::pair("--exposure", exposure), std::pair("--tonemap", toneMap)}) {
        if (value.empty()) continue;
        if (pngs().empty()) fail(ExitCode::Usage, "{} is for PNGs, and none is asked for", name);
        if (findView(request.view).showsNumbers())
            fail(ExitCode::Usage, "{} is for pictures; --view {} shows numbers", name, request.view);
    }
    checkOutputs(files(), inputFiles(request));
}

void writeOutputs(const RenderOutputs& outputs, RenderSession& session, const FramePlan& plan,
                  const RenderedFrames& run) {
    const FilmImage film = session.readFilm();
    const std::vector<std::string> pngs = outputs.pngs();
    const DisplayOptions display = pngs.empty() ? DisplayOptions{} : chooseDisplay(outputs, film);
    std::vector<std::function<void()>> writes;
    if (!hasEnding(outputs.output, ".png"))
        writes.push_back([&] {
            LayeredImage image = toLayers(film);
            describe(image, session, film.frames, plan, run);
            writeExr(outputs.output, image);
        });
    for (const std::string& png : pngs)
        writes.push_back([&] { writePng(png, session.view().display(film, display)); });
    if (!outputs.stats.empty())
        writes.push_back([&] { writeStats(outputs.stats, session, plan, run, display); });
    tryAll(writes);
    printResult("{}\n", outputs.output);
    if (!outputs.png.empty()) printResult("{}\n", outputs.png);
}

} // namespace irradia
