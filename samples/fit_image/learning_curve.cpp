#include "samples/fit_image/learning_curve.h"

#include "engine/error.h"
#include "engine/image/read_file.h"
#include "samples/fit_image/chart_svg.h"
#include <cstdio>
#include <sstream>

namespace irradia {
namespace {

constexpr const char* kHeader = "step,seconds,loss,psnr";

ChartPanel panelOf(const std::vector<LearningCurve>& curves, const char* label, bool logarithmic,
                   double CurvePoint::*value) {
    ChartPanel panel{label, logarithmic, {}};
    for (const LearningCurve& curve : curves) {
        ChartLine line{curve.name, {}};
        for (const CurvePoint& point : curve.points) line.points.emplace_back(point.seconds, point.*value);
        panel.lines.push_back(std::move(line));
    }
    return panel;
}

} // namespace

std::string toCsv(const LearningCurve& curve) {
    std::string text = fmt::format("{}\n", kHeader);
    for (const CurvePoint& point : curve.points)
        text += fmt::format("{},{:.4f},{:.6g},{:.4f}\n", point.step, point.seconds, point.loss, point.psnr);
    return text;
}

LearningCurve readCsv(const std::filesystem::path& file) {
    const std::vector<uint8_t> bytes = readFile(file);
    std::istringstream lines(std::string(bytes.begin(), bytes.end()));
    std::string line;
    if (!std::getline(lines, line) || line != kHeader)
        fail(ExitCode::BadData, "{}: the first line is not \"{}\"", file.string(), kHeader);
    LearningCurve curve{file.stem().string(), {}};
    while (std::getline(lines, line)) {
        CurvePoint point;
        int used = 0;
        const int read = std::sscanf(line.c_str(), "%9u,%lf,%lf,%lf%n", &point.step, &point.seconds,
                                     &point.loss, &point.psnr, &used);
        if (read != 4 || static_cast<size_t>(used) != line.size())
            fail(ExitCode::BadData, "{}: line {} is not four numbers", file.string(),
                 curve.points.size() + 2);
        curve.points.push_back(point);
    }
    return curve;
}

std::string toChart(const std::vector<LearningCurve>& curves, const std::string& title,
                    const std::string& subtitle) {
    return chartSvg({title,
                     subtitle,
                     "seconds of learning",
                     {panelOf(curves, "PSNR, dB", false, &CurvePoint::psnr),
                      panelOf(curves, "loss", true, &CurvePoint::loss)}});
}

} // namespace irradia
