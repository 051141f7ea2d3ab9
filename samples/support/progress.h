// Progress on stderr: a bar on a terminal, a line every few seconds elsewhere, or one JSON object per line.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace irradia {

class ProgressMeter {
public:
    // mode: auto, bar, lines, json or none. `unit` is what one update stands for; the rate counts them.
    ProgressMeter(std::string task, const std::string& mode, std::string unit = "frames");
    ~ProgressMeter(); // leaves the bar's line, so that an error starts on its own
    ProgressMeter(const ProgressMeter&) = delete;
    ProgressMeter& operator=(const ProgressMeter&) = delete;

    void update(double fraction); // one unit more is done; fraction of the whole task in [0, 1]
    void note(const std::string& name, double value); // shown from now on, "psnr 31.2"
    void finish();                                    // the last state is always shown

private:
    enum class Form { Bar, Lines, Json, None };
    using Clock = std::chrono::steady_clock;

    static Form formOf(const std::string& mode);
    double interval() const; // seconds between two outputs
    void show();
    std::string barText(double elapsed) const;
    std::string lineText(double elapsed) const;
    std::string jsonText(double elapsed) const;
    double secondsLeft(double elapsed) const; // infinite before the first update

    std::string task_;
    std::string unit_;
    Form form_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point shown_ = start_;
    uint64_t units_ = 0;
    double fraction_ = 0;
    std::vector<std::pair<std::string, double>> notes_;
    bool lineOpen_ = false; // a bar stands on the terminal's line
};

// --progress
void addProgressOption(CLI::App& command, std::string& mode);

} // namespace irradia
