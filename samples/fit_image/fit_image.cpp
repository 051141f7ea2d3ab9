#include "samples/fit_image/fit_image.h"

#include "default_network.h"
#include "engine/error.h"
#include "engine/image/display.h"
#include "engine/image/image.h"
#include "engine/log.h"
#include "samples/fit_image/image_learner.h"
#include "samples/fit_image/learning_curve.h"
#include "samples/support/interrupt.h"
#include "samples/support/outputs.h"
#include "samples/support/progress.h"
#include "samples/support/standard_streams.h"
#include <bit>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

uint32_t log2Batch(uint32_t batch) {
    if (!std::has_single_bit(batch) || batch < 1u << 8 || batch > 1u << 18)
        fail(ExitCode::Usage, "--batch {}: not a power of two from 256 to 262144", batch);
    return static_cast<uint32_t>(std::countr_zero(batch));
}

ModelConfig chooseNetwork(const FitOptions& options) {
    return options.network.empty() ? parseModelConfig(kDefaultNetwork, "hash_grid.json")
                                   : loadModelConfig(options.network);
}

void checkFiles(const FitOptions& options) {
    requireEnding({"-o", options.output}, {".exr"});
    requireEnding({"--png", options.png}, {".png"});
    requireEnding({"--chart", options.chart}, {".svg", "-"});
    std::vector<NamedFile> inputs{{"the picture", options.picture}, {"the network", options.network}};
    for (const std::string& file : options.against) inputs.push_back({"a curve of --against", file});
    checkOutputs({{"-o", options.output},
                  {"--png", options.png},
                  {"--csv", options.csv},
                  {"--chart", options.chart},
                  {"--save", options.save},
                  {"--json", options.json}},
                 inputs);
}

std::vector<LearningCurve> readCurves(const std::vector<std::string>& files) {
    std::vector<LearningCurve> curves;
    for (const std::string& file : files) curves.push_back(readCsv(file));
    return curves;
}

// The steps after which the picture is measured: about ten in each doubling, so that a logarithm sees them
// evenly.
uint32_t nextMeasurement(uint32_t step) {
    return std::max(step + 1, static_cast<uint32_t>(std::lround(step * 1.1)));
}

struct Result {
    LearningCurve curve;
    std::vector<glm::vec3> picture;
    double psnr = 0; // of the whole picture
};

// Learns until the steps or the seconds are over. Only learning counts as time.
LearningCurve learn(ImageLearner& learner, const FitOptions& options) {
    LearningCurve curve{"", {}};
    ProgressMeter progress("fit", options.progress, "steps");
    double seconds = 0;
    uint32_t step = 0;
    for (bool isLast = false; !isLast;) {
        const auto start = Clock::now();
        learner.step();
        seconds += secondsSince(start);
        ++step;
        const double fraction =
            options.seconds > 0 ? seconds / options.seconds : double(step) / options.steps;
        isLast = fraction >= 1 || interruptedBy();
        if (isLast || curve.points.empty() || step >= nextMeasurement(curve.points.back().step)) {
            curve.points.push_back({step, seconds, learner.trainer().counts().loss, learner.measure()});
            progress.note("loss", curve.points.back().loss);
            progress.note("psnr", curve.points.back().psnr);
        }
        progress.update(fraction);
    }
    progress.finish();
    return curve;
}

Result run(ImageLearner& learner, const Picture& picture, const FitOptions& options) {
    const auto start = Clock::now();
    learner.warmUp();
    stopIfInterrupted();
    logLine("kernels ready after {:.1f} s", secondsSince(start));
    Result result{learn(learner, options), learner.predict(), 0};
    result.curve.name =
        options.network.empty() ? "hash_grid" : std::filesystem::path(options.network).stem().string();
    DisplayError error;
    for (size_t i = 0; i < result.picture.size(); ++i) error.add(result.picture[i], picture.colour(i));
    result.psnr = error.psnr();
    const CurvePoint& last = result.curve.points.back();
    logLine("{:.2f} dB over all {} pixels after {} steps, {:.1f} s of learning, {:.2f} ms a step",
            result.psnr, result.picture.size(), last.step, last.seconds, 1e3 * last.seconds / last.step);
    return result;
}

nlohmann::ordered_json numbers(const Result& result, const Picture& picture, ImageLearner& learner,
                               const Device& device, const FitOptions& options) {
    const CurvePoint& last = result.curve.points.back();
    const TrainingCounts counts = learner.trainer().counts();
    auto passes = nlohmann::ordered_json::array();
    for (const Profiler::Row& row : learner.profiler().rows())
        passes.push_back({{"name", row.name}, {"p50", row.p50}, {"p90", row.p90}, {"runs", row.runs}});
    return {{"device", device.description().name},
            {"driver", device.description().driver},
            {"picture", options.picture},
            {"width", picture.width},
            {"height", picture.height},
            {"network", nlohmann::ordered_json::parse(toJson(learner.trainer().config()))},
            {"parameters", learner.trainer().parameterCount()},
            {"batch", options.batch},
            {"seed", options.seed},
            {"steps", last.step},
            {"seconds", last.seconds},
            {"milliseconds_per_step", learner.profiler().wall().p50},
            {"loss", last.loss},
            {"psnr", result.psnr},
            {"dropped_records", counts.droppedRecords},
            {"damaged_parameters", counts.damagedParameters},
            {"memory_bytes", device.memoryUsed()},
            {"passes", passes}}; // of a step, milliseconds
}

void writeText(const std::string& file, const std::string& text) {
    if (file == "-")
        writeResult(text);
    else
        writeFileAtomically(file, std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

// The learned picture with everything that decides it.
void writeLearned(const Result& result, const Picture& picture, ImageLearner& learner, const Device& device,
                  const FitOptions& options) {
    LayeredImage image;
    image.width = static_cast<int>(picture.width);
    image.height = static_cast<int>(picture.height);
    image.setRgb("", result.picture);
    auto& a = image.attributes;
    a["irradia.version"] = IRRADIA_VERSION;
    a["irradia.device"] = device.description().name;
    a["irradia.driver"] = device.description().driver;
    a["irradia.network"] = toJson(learner.trainer().config());
    a["irradia.seed"] = std::to_string(options.seed);
    a["irradia.options"] =
        fmt::format("--steps {} --batch {}", result.curve.points.back().step, options.batch);
    writeExr(options.output, image);
}

void writeChart(const Result& result, const std::vector<LearningCurve>& earlier, const Picture& picture,
                ImageLearner& learner, const Device& device, const FitOptions& options) {
    std::vector<LearningCurve> curves{result.curve};
    curves.insert(curves.end(), earlier.begin(), earlier.end());
    const std::string name = std::filesystem::path(options.picture).filename().string();
    const bool isAlone = earlier.empty();
    const std::string title = fmt::format(
        "{} as learned by {}", name, isAlone ? result.curve.name : fmt::format("{} networks", curves.size()));
    const std::string network = isAlone ? describe(learner.trainer().network().config()) + ", " : "";
    const std::string subtitle =
        fmt::format("{} x {} pixels, {}batches of {}, on {}", picture.width, picture.height, network,
                    options.batch, device.description().name);
    writeText(options.chart, toChart(curves, title, subtitle));
}

} // namespace

void fitImage(const FitOptions& options) {
    const LearnerOptions learnerOptions{log2Batch(options.batch), options.seed};
    checkFiles(options);
    const ModelConfig config = chooseNetwork(options);
    const std::vector<LearningCurve> earlier = readCurves(options.against);
    const Picture picture = loadPicture(options.picture);
    Device device(options.device);
    logLine("picture {}: {} x {}; device {} ({})", options.picture, picture.width, picture.height,
            device.description().name, device.description().driver);
    ImageLearner learner(device, picture, config, learnerOptions);
    logLine("network {}, {} parameters", describe(learner.trainer().network().config()),
            learner.trainer().parameterCount());

    const Result result = run(learner, picture, options);
    writeLearned(result, picture, learner, device, options);
    if (!options.png.empty())
        writePng(options.png, toDisplay(static_cast<int>(picture.width), static_cast<int>(picture.height),
                                        result.picture));
    if (!options.csv.empty()) writeText(options.csv, toCsv(result.curve));
    if (!options.chart.empty()) writeChart(result, earlier, picture, learner, device, options);
    if (!options.save.empty()) learner.trainer().save(options.save);
    if (!options.json.empty())
        writeText(options.json, numbers(result, picture, learner, device, options).dump(2) + "\n");
    if (device.validationMessages() > 0)
        fail(ExitCode::Internal, "{} validation messages", device.validationMessages());
    endIfInterrupted(result.curve.points.back().step, "steps");
}

} // namespace irradia
