// Line charts as a self-contained SVG: panels above each other that share their x axis, on white.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace irradia {

struct ChartLine {
    std::string name; // in the legend, which a chart of one line does without
    std::vector<glm::dvec2> points;
};

struct ChartPanel {
    std::string yLabel;
    bool logarithmic = false; // y; values that are not positive are left out
    std::vector<ChartLine> lines;
};

struct Chart {
    std::string title;
    std::string subtitle;
    std::string xLabel;
    std::vector<ChartPanel> panels;
};

std::string chartSvg(const Chart& chart);

} // namespace irradia
