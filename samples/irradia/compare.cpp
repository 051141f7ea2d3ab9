// irradia compare: how far a picture is from its reference, and whether that is too far.
#include "commands.h"
#include "engine/error.h"
#include "engine/image/image.h"
#include "engine/image/metrics.h"
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
    double (*value)(const ImageMetrics&);
};

constexpr Metric kMetrics[] = {
    {"mse", "mean squared error", [](const ImageMetrics& m) { return m.mse; }},
    {"relmse", "relative mean squared error", [](const ImageMetrics& m) { return m.relMse; }},
    {"mape", "mean absolute relative error", [](const ImageMetrics& m) { return m.mape; }},
    {"mean_ratio", "mean luminance over the reference's", [](const ImageMetrics& m) { return m.meanRatio; }},
    {"flip", "mean difference seen on a screen", [](const ImageMetrics& m) { return m.flip; }},
    {"nonfinite", "values that are not finite",
     [](const ImageMetrics& m) { return static_cast<double>(m.nonFinite); }},
};

struct Limit {
    const Metric* metric;
    double value;
};

const Metric& findMetric(const std::string& name) {
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

LayeredImage readPicture(const std::string& file) {
    return file.ends_with(".hdr") ? readHdr(file) : readExr(file);
}

ImageMetrics measure(const CompareOptions& options) {
    const LayeredImage test = readPicture(options.test);
    const LayeredImage reference = readPicture(options.reference);
    if (test.width != reference.width || test.height != reference.height)
        fail(ExitCode::BadData, "{} has {} x {} pixels, but {} has {} x {}", options.test, test.width,
             test.height, options.reference, reference.width, reference.height);
    return compareImages(test.width, test.height, test.rgb(), reference.rgb());
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
        if (value <= limit) continue; // NaN is above every limit
        failures += fmt::format("{}{} {:.6g} is above {:.6g}", failures.empty() ? "" : ", ", metric->name,
                                value, limit);
    }
    if (!failures.empty()) fail(ExitCode::Failed, "{}: {}", options.test, failures);
}

} // namespace

void addCompare(CLI::App& program) {
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = program.add_subcommand("compare", "Measure how far a picture is from its reference");
    command->add_option("picture", options->test, "EXR or HDR file")->required();
    command->add_option("reference", options->reference, "EXR or HDR file of the same size")->required();
    command->add_flag("--json", options->json, "Print one JSON object instead of a table");
    command
        ->add_option(
            "--fail-above", options->failAbove,
            "End with exit code 1 if a metric is above X: mse, relmse, mape, mean_ratio, flip, nonfinite")
        ->type_name("METRIC=X")
        ->allow_extra_args(false); // else it would eat the file names after it
    command->callback([options] { compare(*options); });
}

} // namespace irradia
