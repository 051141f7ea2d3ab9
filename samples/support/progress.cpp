#include "progress.h"

#include "engine/log.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace irradia {
namespace {

// "4.2 s", "3:07", "2:15:09", "?".
std::string durationText(double seconds) {
    if (!std::isfinite(seconds)) return "?";
    if (seconds < 10) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<uint64_t>(std::llround(std::min(seconds, 1e9)));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

double rate(uint64_t units, double elapsed) {
    return elapsed > 0 ? static_cast<double>(units) / elapsed : 0;
}

} // namespace

ProgressMeter::ProgressMeter(std::string task, const std::string& mode, std::string unit)
    : task_(std::move(task))
    , unit_(std::move(unit))
    , form_(formOf(mode)) {}

ProgressMeter::~ProgressMeter() {
    if (lineOpen_) logText("\n");
}

ProgressMeter::Form ProgressMeter::formOf(const std::string& mode) {
    if (mode == "json") return Form::Json;
    if (mode == "none") return Form::None;
    if (mode == "bar" || (mode == "auto" && ::isatty(STDERR_FILENO))) return Form::Bar;
    return Form::Lines;
}

double ProgressMeter::interval() const {
    switch (form_) {
    case Form::Bar:
        return 0.1;
    case Form::Json:
        return 0.5;
    default:
        return 5;
    }
}

void ProgressMeter::update(double fraction) {
    ++units_;
    fraction_ = std::clamp(fraction, 0.0, 1.0);
    if (std::chrono::duration<double>(Clock::now() - shown_).count() >= interval()) show();
}

void ProgressMeter::note(const std::string& name, double value) {
    const auto found = std::ranges::find(notes_, name, &std::pair<std::string, double>::first);
    if (found == notes_.end())
        notes_.emplace_back(name, value);
    else
        found->second = value;
}

void ProgressMeter::finish() {
    show();
    if (lineOpen_) logText("\n");
    lineOpen_ = false;
}

void ProgressMeter::show() {
    shown_ = Clock::now();
    const double elapsed = std::chrono::duration<double>(shown_ - start_).count();
    switch (form_) {
    case Form::Bar:
        logText(fmt::format("\r{}\x1b[K", barText(elapsed))); // the escape clears what a longer line left
        lineOpen_ = true;
        break;
    case Form::Lines:
        logLine("{}", lineText(elapsed));
        break;
    case Form::Json:
        logLine("{}", jsonText(elapsed));
        break;
    case Form::None:
        break;
    }
}

std::string ProgressMeter::barText(double elapsed) const {
    constexpr int kCells = 30;
    const int full = static_cast<int>(std::lround(fraction_ * kCells));
    return fmt::format("{} [{:#<{}}{:.<{}}] {}", task_, "", full, "", kCells - full, lineText(elapsed));
}

std::string ProgressMeter::lineText(double elapsed) const {
    const std::string name = form_ == Form::Lines ? task_ + ": " : "";
    std::string text = fmt::format("{}{:.0f} %, {} {}, {:.3g} {}/s, {} so far, {} left", name,
                                   100 * fraction_, units_, unit_, rate(units_, elapsed), unit_,
                                   durationText(elapsed), durationText(secondsLeft(elapsed)));
    for (const auto& [noted, value] : notes_) text += fmt::format(", {} {:.4g}", noted, value);
    return text;
}

std::string ProgressMeter::jsonText(double elapsed) const {
    // An infinite number becomes null.
    nlohmann::ordered_json json{{"task", task_},        {"fraction", fraction_},
                                {unit_, units_},        {"rate", rate(units_, elapsed)},
                                {"elapsed_s", elapsed}, {"eta_s", secondsLeft(elapsed)}};
    for (const auto& [noted, value] : notes_) json[noted] = value;
    return json.dump();
}

double ProgressMeter::secondsLeft(double elapsed) const {
    return fraction_ > 0 ? elapsed * (1 - fraction_) / fraction_ : std::numeric_limits<double>::infinity();
}

void addProgressOption(CLI::App& command, std::string& mode) {
    command
        .add_option("--progress", mode, "auto (a bar on a terminal, else lines), bar, lines, json or none")
        ->check(CLI::IsMember({"auto", "bar", "lines", "json", "none"}))
        ->capture_default_str();
}

} // namespace irradia
