#include "samples/fit_image/chart_svg.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace irradia {
namespace {

constexpr double kWidth = 800;
constexpr double kPanelHeight = 260;
constexpr double kPanelGap = 34;
constexpr double kLeft = 76, kTop = 74, kBottom = 56;
constexpr double kLegendWidth = 150;

// Told apart by colour-blind eyes as well (Okabe and Ito 2008).
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#444444"};

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '<')
            result += "&lt;";
        else if (c == '&')
            result += "&amp;";
        else if (static_cast<unsigned char>(c) >= 0x20) // XML knows no control characters
            result += c;
    }
    return result;
}

// Values along an axis, and where they stand between its two pixels.
class Axis {
public:
    Axis(double low, double high, bool logarithmic, double from, double to)
        : low_(low)
        , high_(high)
        , logarithmic_(logarithmic)
        , from_(from)
        , to_(to) {}

    double place(double value) const {
        return from_ + (to_ - from_) * (scaled(value) - scaled(low_)) / (scaled(high_) - scaled(low_));
    }

    // Round numbers: 1, 2 or 5 times a power of ten apart, or the powers of ten themselves.
    std::vector<double> ticks() const {
        std::vector<double> result;
        if (logarithmic_) {
            for (double e = std::ceil(scaled(low_) - 1e-9); e <= scaled(high_) + 1e-9; ++e)
                result.push_back(std::pow(10.0, e));
            return result;
        }
        const double step = tickStep(low_, high_);
        for (double i = std::ceil(low_ / step - 1e-9); i * step <= high_ + 1e-9 * step; ++i)
            result.push_back(i * step + 0.0); // no -0
        return result;
    }

    static double tickStep(double low, double high) {
        const double rough = (high - low) / 6, power = std::pow(10.0, std::floor(std::log10(rough)));
        return power * (rough / power <= 1 ? 1 : rough / power <= 2 ? 2 : rough / power <= 5 ? 5 : 10);
    }

private:
    double scaled(double value) const { return logarithmic_ ? std::log10(value) : value; }

    double low_, high_;
    bool logarithmic_;
    double from_, to_; // pixels of low and high
};

bool isShown(const glm::dvec2& point, bool logarithmic) {
    return std::isfinite(point.x) && std::isfinite(point.y) && (!logarithmic || point.y > 0);
}

struct Bounds {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

Axis yAxis(const ChartPanel& panel, double top) {
    Bounds bounds;
    for (const ChartLine& line : panel.lines)
        for (const glm::dvec2& point : line.points)
            if (isShown(point, panel.logarithmic)) bounds.add(point.y);
    if (!(bounds.low <= bounds.high)) bounds = {1, 10};
    if (panel.logarithmic) {
        bounds = {std::pow(10.0, std::floor(std::log10(bounds.low))),
                  std::pow(10.0, std::ceil(std::log10(bounds.high)))};
        if (bounds.low == bounds.high) bounds.high *= 10;
    } else {
        if (bounds.low == bounds.high) bounds = {bounds.low - 1, bounds.high + 1};
        const double step = Axis::tickStep(bounds.low, bounds.high);
        bounds = {step * std::floor(bounds.low / step), step * std::ceil(bounds.high / step)};
    }
    return {bounds.low, bounds.high, panel.logarithmic, top + kPanelHeight, top};
}

Axis xAxis(const Chart& chart, double right) {
    Bounds bounds;
    for (const ChartPanel& panel : chart.panels)
        for (const ChartLine& line : panel.lines)
            for (const glm::dvec2& point : line.points)
                if (isShown(point, panel.logarithmic)) bounds.add(point.x);
    return {0, bounds.high > 0 ? bounds.high : 1, false, kLeft, right};
}

std::string text(double x, double y, const char* style, const std::string& content) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style, escaped(content));
}

std::string gridLine(double x1, double y1, double x2, double y2) {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#e3e6ea\"/>\n",
                       x1, y1, x2, y2);
}

std::string lineSvg(const ChartLine& line, const ChartPanel& panel, const Axis& x, const Axis& y,
                    const char* colour) {
    std::string points;
    for (const glm::dvec2& point : line.points)
        if (isShown(point, panel.logarithmic))
            points +=
                fmt::format("{}{:.2f},{:.2f}", points.empty() ? "" : " ", x.place(point.x), y.place(point.y));
    return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" "
                       "stroke-linejoin=\"round\"/>\n",
                       points, colour);
}

const char* colourOf(size_t line) {
    return kColours[line % std::size(kColours)];
}

std::string panelSvg(const ChartPanel& panel, const Axis& x, double top, double right, bool isLast) {
    const Axis y = yAxis(panel, top);
    const double bottom = top + kPanelHeight;
    std::string svg;
    for (const double value : y.ticks()) {
        svg += gridLine(kLeft, y.place(value), right, y.place(value));
        svg += text(kLeft - 8, y.place(value) + 4, "text-anchor=\"end\"", fmt::format("{:.6g}", value));
    }
    for (const double value : x.ticks()) {
        svg += gridLine(x.place(value), top, x.place(value), bottom);
        if (isLast)
            svg += text(x.place(value), bottom + 18, "text-anchor=\"middle\"", fmt::format("{:.6g}", value));
    }
    svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}H{3:.1f}\" fill=\"none\" stroke=\"#555c66\"/>\n",
                       kLeft, top, bottom, right);
    for (size_t i = 0; i < panel.lines.size(); ++i) svg += lineSvg(panel.lines[i], panel, x, y, colourOf(i));
    svg += text(kLeft, top - 9, "font-weight=\"600\"", panel.yLabel);
    return svg;
}

std::string legendSvg(const std::vector<ChartLine>& lines, double left) {
    std::string svg;
    for (size_t i = 0; i < lines.size(); ++i) {
        const double y = kTop + 10 + 22 * static_cast<double>(i);
        svg += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{2:.1f}\" y2=\"{1:.1f}\" stroke=\"{3}\" "
                           "stroke-width=\"3\"/>\n",
                           left, y, left + 22, colourOf(i));
        svg += text(left + 30, y + 4, "", lines[i].name);
    }
    return svg;
}

} // namespace

std::string chartSvg(const Chart& chart) {
    const bool hasLegend = !chart.panels.empty() && chart.panels.front().lines.size() > 1;
    const double right = kWidth - (hasLegend ? kLegendWidth : 24);
    const double panels = static_cast<double>(chart.panels.size());
    const double bottom = kTop + panels * kPanelHeight + std::max(0.0, panels - 1) * kPanelGap;
    const Axis x = xAxis(chart, right);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"system-ui, sans-serif\" font-size=\"13\" fill=\"#2b3138\">\n",
        kWidth, bottom + kBottom);
    svg += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    svg += text(kLeft, 26, "font-size=\"17\" font-weight=\"600\"", chart.title);
    svg += text(kLeft, 45, "fill=\"#68717c\"", chart.subtitle);
    double top = kTop;
    for (size_t i = 0; i < chart.panels.size(); ++i) {
        svg += panelSvg(chart.panels[i], x, top, right, i + 1 == chart.panels.size());
        top += kPanelHeight + kPanelGap;
    }
    if (hasLegend) svg += legendSvg(chart.panels.front().lines, right + 16);
    svg += text(0.5 * (kLeft + right), bottom + 40, "text-anchor=\"middle\"", chart.xLabel);
    return svg + "</svg>\n";
}

} // namespace irradia
