// irradia compare: how far a picture is from its reference, and whether that is too far.
#include "commands.h"
#include "engine/error.h"
#include "engine/image/metrics.h"
#include "engine/image/picture_file.h"
#include "engine/log.h"
#include "samples/support/numbers.h"
#include "samples/support/standard_streams.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

struct CompareOptions {
    std::string test;
    std::string reference;
    bool json = false;
    std::vector<std::string> failAbove; // METRIC=X
};

struct Metric {
    const char* name;
    const char* meaning;
    const char* definition;
    double (*value)(const ImageMetrics&);
};

constexpr Metric kMetrics[] = {
    {"mse", "mean squared error", "mean of (t - r)^2", [](const ImageMetrics& m) { return m.mse; }},
    {"relmse", "relative mean squared error", "mean of (t - r)^2 / (r^2 + 0.01)",
     [](const ImageMetrics& m) { return m.relMse; }},
    {"mape", "mean absolute relative error", "mean of |t - r| / (|r| + 0.01)",
     [](const ImageMetrics& m) { return m.mape; }},
    {"mean_ratio", "mean luminance over the reference's",
     "mean luminance of t / that of r, luminance = 0.2126 R + 0.7152 G + 0.0722 B",
     [](const ImageMetrics& m) { return m.meanRatio; }},
    {"flip", "mean difference seen on a screen",
     "mean LDR-FLIP (Andersson et al. 2020) of both as an sRGB screen shows them at exposure 1",
     [](const ImageMetrics& m) { return m.flip; }},
    {"nonfinite", "values that are not finite", "number of values of t that are NaN or infinite",
     [](const ImageMetrics& m) { return static_cast<double>(m.nonFinite); }},
};

// For --help.
std::string definitions() {
    std::string text = "Of a picture t and its reference r, linear radiance, over pixels and channels:\n";
    for (const Metric& metric : kMetrics)
        text += fmt::format("  {:<10}  {}\n", metric.name, metric.definition);
    return text +
           "Values of t that are not finite are in no mean, and fail every metric under --fail-above.\n"
           "Of a FILE.exr:LAYER that layer is compared; what lies outside an EXR's data window is black.";
}

struct Limit {
    const Metric* metric;
    double value;
};

const Metric& findMetric(std::string_view name) {
    const auto* found =
        std::ranges::find_if(kMetrics, [&](const Metric& metric) { return name == metric.name; });
    if (found != std::end(kMetrics)) return *found;
    std::string known;
    for (const Metric& metric : kMetrics)
        known += fmt::format("{}{}", known.empty() ? "" : ", ", metric.name);
    fail(ExitCode::Usage, "--fail-above: unknown metric {}, there are {}", name, known);
}

Limit parseLimit(const std::string& text) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos) fail(ExitCode::Usage, "--fail-above {}: not METRIC=X", text);
    const Metric& metric = findMetric(text.substr(0, equals));
    const auto value = toNumber(text.substr(equals + 1));
    if (!value) fail(ExitCode::Usage, "--fail-above {}: {} is not a number", text, text.substr(equals + 1));
    return {&metric, *value};
}

struct Radiance {
    LayeredImage image;
    std::vector<glm::vec3> pixels;
};

Radiance readRadiance(const std::string& text) {
    const PictureName name = parsePictureName(text);
    LayeredImage image = readPicture(name);
    std::vector<glm::vec3> pixels = image.rgb(name.layer);
    return {std::move(image), std::move(pixels)};
}

// A reference that was rendered says how noisy it is: its noise is in every difference.
void warnOfNoise(const Radiance& reference, const ImageMetrics& metrics) {
    constexpr double kSmall = 0.1; // of the difference
    if (!reference.image.channels.contains("Variance.R")) return;
    const double noise = relativeVariance(reference.pixels, reference.image.rgb("Variance"));
    if (metrics.relMse == 0 || !(noise > kSmall * metrics.relMse)) return;
    logLine("warning: the reference's own noise is a relmse of {:.3g}, {:.0f} % of the difference: take one "
            "of more "
            "samples",
            noise, 100 * noise / metrics.relMse);
}

ImageMetrics measure(const CompareOptions& options) {
    const Radiance test = readRadiance(options.test);
    const Radiance reference = readRadiance(options.reference);
    const int width = test.image.width, height = test.image.height;
    if (width != reference.image.width || height != reference.image.height)
        fail(ExitCode::BadData, "{} has {} x {} pixels, but {} has {} x {}", options.test, width, height,
             options.reference, reference.image.width, reference.image.height);
    const ImageMetrics metrics = compareImages(width, height, test.pixels, reference.pixels);
    if (metrics.nonFinitePixels > 0)
        logLine("warning: {} of {} pixels are not finite and in no mean", metrics.nonFinitePixels,
                test.pixels.size());
    warnOfNoise(reference, metrics);
    return metrics;
}

void printMetrics(const ImageMetrics& metrics, bool asJson) {
    nlohmann::ordered_json json;
    for (const Metric& metric : kMetrics) {
        const double value = metric.value(metrics);
        if (asJson)
            json[metric.name] = value; // null where it is not finite
        else
            printResult("{:<10}  {:>12.6g}  {}\n", metric.name, value, metric.meaning);
    }
    json["nonfinite"] = metrics.nonFinite; // a whole number
    if (asJson) printResult("{}\n", json.dump());
}

void compare(const CompareOptions& options) {
    std::vector<Limit> limits;
    for (const std::string& text : options.failAbove) limits.push_back(parseLimit(text));
    const ImageMetrics metrics = measure(options);
    printMetrics(metrics, options.json);
    std::string failures;
    for (const auto& [metric, limit] : limits) {
        const double value = metric->value(metrics);
        const bool isWhole = metrics.nonFinite == 0 || metric->name == std::string_view("nonfinite");
        if (isWhole && value <= limit) continue; // NaN is above every limit
        failures += failures.empty() ? "" : ", ";
        failures += isWhole ? fmt::format("{} {:.6g} is above {:.6g}", metric->name, value, limit)
                            : fmt::format("{} fails by {} pixels that are not finite", metric->name,
                                          metrics.nonFinitePixels);
    }
    if (!failures.empty()) fail(ExitCode::Failed, "{}: {}", options.test, failures);
}

} // namespace

void addCompare(CLI::App& program) {
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = program.add_subcommand("compare", "Measure how far a picture is from its reference");
    command->add_option("picture", options->test, "EXR or HDR file, or FILE.exr:LAYER")->required();
    command->add_option("reference", options->reference, "EXR or HDR file of the same size")->required();
    command->add_flag("--json", options->json, "Print one JSON object instead of a table");
    command
        ->add_option(
            "--fail-above", options->failAbove,
            "End with exit code 1 if a metric is above X: mse, relmse, mape, mean_ratio, flip, nonfinite")
        ->type_name("METRIC=X")
        ->allow_extra_args(false); // else it would eat the file names after it
    command->footer(definitions());
    command->callback([options] { compare(*options); });
}

} // namespace irradia
