// How learning went: measurements over steps and time, as CSV and as a chart.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace irradia {

struct CurvePoint {
    uint32_t step = 0;
    double seconds = 0; // of learning alone: without compiling and measuring
    double loss = 0;    // of that step's batch
    double psnr = 0;    // dB
};

struct LearningCurve {
    std::string name;
    std::vector<CurvePoint> points;
};

// "step,seconds,loss,psnr" and a line a point.
std::string toCsv(const LearningCurve& curve);
// Of a file that toCsv wrote, named by it. Throws Error: NotFound, BadData naming the line.
LearningCurve readCsv(const std::filesystem::path& file);

// PSNR and loss over seconds.
std::string toChart(const std::vector<LearningCurve>& curves, const std::string& title,
                    const std::string& subtitle);

} // namespace irradia
