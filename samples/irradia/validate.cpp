// irradia validate: every fault of a scene at once, in the words of Khronos' glTF validator.
#include "commands.h"
#include "engine/error.h"
#include "engine/image/read_file.h"
#include "engine/scene/validate_scene.h"
#include "samples/support/sheet.h"
#include "samples/support/standard_streams.h"
#include <algorithm>
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

struct ValidateOptions {
    std::vector<std::string> files;
    bool json = false;
};

using Findings = std::vector<Finding>;

const char* nameOf(Severity severity) {
    switch (severity) {
    case Severity::Error:
        return "error";
    case Severity::Warning:
        return "warning";
    default:
        return "info";
    }
}

int64_t count(const Findings& findings, Severity severity) {
    return std::ranges::count(findings, severity, &Finding::severity);
}

std::string counted(int64_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string summary(const Findings& findings) {
    const std::string text = fmt::format("{}, {}", counted(count(findings, Severity::Error), "error"),
                                         counted(count(findings, Severity::Warning), "warning"));
    const int64_t infos = count(findings, Severity::Info);
    return infos == 0 ? text : fmt::format("{}, {} not rendered (render --strict refuses)", text, infos);
}

void printFindings(const std::string& file, const Findings& findings) {
    printResult("{}: {}\n", file, summary(findings));
    const auto orDash = [](const std::string& text) { return text.empty() ? "-" : text; };
    std::vector<Row> rows;
    for (const Finding& finding : findings)
        rows.push_back({std::string("  ") + nameOf(finding.severity), orDash(finding.code),
                        orDash(finding.pointer), finding.sentence});
    if (!rows.empty()) printTable(rows);
}

nlohmann::ordered_json toJson(const std::string& file, const Findings& findings) {
    auto rows = nlohmann::ordered_json::array();
    for (const Finding& finding : findings)
        rows.push_back({{"severity", nameOf(finding.severity)},
                        {"code", finding.code},
                        {"pointer", finding.pointer},
                        {"sentence", finding.sentence}});
    return {{"file", file},
            {"errors", count(findings, Severity::Error)},
            {"warnings", count(findings, Severity::Warning)},
            {"infos", count(findings, Severity::Info)},
            {"findings", rows}};
}

void validate(const ValidateOptions& options) {
    for (const std::string& file : options.files) requireFile(file); // before any work
    auto list = nlohmann::ordered_json::array();
    std::string broken;
    size_t brokenCount = 0;
    for (const std::string& file : options.files) {
        Findings findings = validateScene(file);
        std::ranges::stable_sort(findings, {}, &Finding::severity); // errors first
        if (options.json)
            list.push_back(toJson(file, findings));
        else
            printFindings(file, findings);
        if (const int64_t errors = count(findings, Severity::Error); errors > 0 && ++brokenCount == 1)
            broken = fmt::format("{}: {}", file, counted(errors, "error"));
    }
    if (options.json) printJson({{"files", list}});
    if (brokenCount > 1)
        fail(ExitCode::BadData, "{} of {} scenes have errors", brokenCount, options.files.size());
    if (brokenCount == 1) fail(ExitCode::BadData, "{}", broken);
}

constexpr const char* kMeaning =
    "One row a fault: severity, the name that Khronos' glTF validator has for it, the place in the JSON, "
    "and\n"
    "what is wrong there. An error: the scene is refused by `render`. A warning: it is mended or left out. "
    "An\n"
    "info: valid glTF that is not rendered. `render` tells both as warnings, which `render --strict` "
    "refuses;\n"
    "of accessors' bounds, alignment and lengths, and of animations, `validate` alone tells. Exit code 65 "
    "where\n"
    "a scene has errors.";

} // namespace

void addValidate(CLI::App& program) {
    auto options = std::make_shared<ValidateOptions>();
    CLI::App* command = program.add_subcommand("validate", "Check a glTF scene and list all its faults");
    command->add_option("scenes", options->files, "glTF files (.gltf or .glb)")
        ->required()
        ->type_name("FILE");
    command->add_flag("--json", options->json, "Print JSON instead of a table");
    command->footer(kMeaning);
    command->callback([options] { validate(*options); });
}

} // namespace irradia
