// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/report_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pellucid::accuracy {
namespace {

// The drawing's size and the rectangle inside the axes, in its units.
constexpr double kWidth = 860, kHeight = 430;
constexpr double kLeft = 72, kRight = 640, kTop = 16, kBottom = 376;

/// Distinguishable with the common colour deficiencies (after Okabe and Ito), and by their markers without
/// colour.
constexpr std::array<const char*, 13> kColours = {"#8a8f98", "#0067b1", "#3fa9dc", "#00835e", "#86b300",
                                                  "#c9480a", "#dd9200", "#b85a94", "#20242a", "#6a3fa0",
                                                  "#8c5a2b", "#a98bd0", "#d01c3a"};

/// One logarithmic axis onto the drawing.
struct Axis {
    double lo = 1.0, hi = 10.0;  ///< Values at `from` and `to`.
    double from = 0.0, to = 1.0;

    [[nodiscard]] double at(double value) const {
        return from + (to - from) * std::log(value / lo) / std::log(hi / lo);
    }
};

bool drawable(const PlotPoint& p) {
    return p.x > 0.0 && p.y > 0.0 && std::isfinite(p.x) && std::isfinite(p.y);
}

/// Spans all values with a margin of a fifteenth of their decades, and at least a factor of three.
Axis axisOver(const std::vector<double>& values, double from, double to) {
    Axis axis{1.0, 10.0, from, to};
    if (values.empty()) return axis;
    const auto [lo, hi] = std::minmax_element(values.begin(), values.end());
    const double margin = std::max(std::pow(*hi / *lo, 1.0 / 15.0), *hi / *lo < 3.0 ? 1.7 : 1.0);
    axis.lo = *lo / margin;
    axis.hi = *hi * margin;
    return axis;
}

/// 1, 2 and 5 of each decade while that leaves room, else decades.
std::vector<double> ticks(const Axis& axis) {
    const double decades = std::log10(axis.hi / axis.lo);
    const bool fine = decades < 3.2;
    std::vector<double> values;
    for (int decade = static_cast<int>(std::floor(std::log10(axis.lo)));
         decade <= std::ceil(std::log10(axis.hi)); ++decade)
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * std::pow(10.0, decade);
            if ((digit == 1.0 || fine) && value >= axis.lo && value <= axis.hi) values.push_back(value);
        }
    return values;
}

std::string tickText(double value) {
    if (value >= 0.0009 && value < 99999.0) return fmt::format("{:g}", value);
    return fmt::format("{:.0e}", value);
}

std::string marker(int style, double x, double y) {
    const char* colour = kColours[static_cast<std::size_t>(style) % kColours.size()];
    switch (style % 5) {
        case 0:
            return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>", x, y, colour);
        case 1:
            return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"7\" height=\"7\" fill=\"{}\"/>",
                               x - 3.5, y - 3.5, colour);
        case 2:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l4.6 8h-9.2z\" fill=\"{}\"/>", x, y - 5.0, colour);
        case 3:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l5 5l-5 5l-5-5z\" fill=\"{}\"/>", x, y - 5.0, colour);
        default:
            return fmt::format(
                "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.4\" fill=\"#fff\" stroke=\"{}\" "
                "stroke-width=\"2\"/>",
                x, y, colour);
    }
}

std::string frame(const Plot& plot, const Axis& x, const Axis& y) {
    std::string svg;
    for (const double value : ticks(x)) {
        const double at = x.at(value);
        svg += fmt::format(
            "<path d=\"M{0:.1f} {1}V{2}\" class=\"grid\"/><text x=\"{0:.1f}\" y=\"{3}\" "
            "class=\"mid\">{4}</text>",
            at, kTop, kBottom, kBottom + 18, tickText(value));
    }
    for (const double value : ticks(y)) {
        const double at = y.at(value);
        svg += fmt::format(
            "<path d=\"M{1} {0:.1f}H{2}\" class=\"grid\"/><text x=\"{3}\" y=\"{4:.1f}\" "
            "class=\"end\">{5}</text>",
            at, kLeft, kRight, kLeft - 8, at + 4, tickText(value));
    }
    for (const double level : plot.levels)
        if (level > y.lo && level < y.hi)
            svg += fmt::format("<path d=\"M{} {:.1f}H{}\" class=\"level\"/>", kLeft, y.at(level), kRight);
    svg += fmt::format("<path d=\"M{} {}V{}H{}\" class=\"axis\"/>", kLeft, kTop, kBottom, kRight);
    svg += fmt::format("<text x=\"{}\" y=\"{}\" class=\"mid title\">{}</text>", (kLeft + kRight) / 2,
                       kHeight - 12, escaped(plot.xTitle));
    svg += fmt::format("<text transform=\"translate(16 {}) rotate(-90)\" class=\"mid title\">{}</text>",
                       (kTop + kBottom) / 2, escaped(plot.yTitle));
    return svg;
}

/// Thin lines through the lower right corner of the plot, as steep as an order is.
std::string guides(const Plot& plot, const Axis& x, const Axis& y) {
    std::string svg;
    const double x1 = x.hi / std::pow(x.hi / x.lo, 0.04);
    const double bottom = y.lo * std::pow(y.hi / y.lo, 0.06);
    for (const double slope : plot.slopes) {
        const double x0 = x1 / std::pow(x.hi / x.lo, 0.16);
        const double y1 = std::min(bottom * std::pow(x1 / x0, slope), y.hi);
        const double xAtTop = x0 * std::pow(y1 / bottom, 1.0 / slope);
        svg += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" class=\"guide\"/>", x.at(x0),
                           y.at(bottom), x.at(xAtTop), y.at(y1));
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"note\">{:g}</text>", x.at(xAtTop) + 4,
                           y.at(y1) + 4, slope);
    }
    return svg;
}

std::string curveText(const PlotCurve& curve, const Axis& x, const Axis& y) {
    std::string line;
    std::string markers;
    for (const PlotPoint& p : curve.points) {
        if (!drawable(p)) continue;
        line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x.at(p.x), y.at(p.y));
        markers += fmt::format("<g>{}<title>{}</title></g>", marker(curve.style, x.at(p.x), y.at(p.y)),
                               escaped(p.label));
    }
    if (line.empty()) return {};
    return fmt::format("<path d=\"{}\" class=\"curve\" stroke=\"{}\"{}/>{}", line,
                       kColours[static_cast<std::size_t>(curve.style) % kColours.size()],
                       curve.dashed ? " stroke-dasharray=\"6 4\"" : "", markers);
}

std::string legend(const Plot& plot) {
    std::string svg;
    double y = kTop + 10;
    for (const PlotCurve& curve : plot.curves) {
        svg += fmt::format("<path d=\"M{} {}h28\" class=\"curve\" stroke=\"{}\"{}/>", kRight + 20, y,
                           kColours[static_cast<std::size_t>(curve.style) % kColours.size()],
                           curve.dashed ? " stroke-dasharray=\"6 4\"" : "");
        svg += marker(curve.style, kRight + 34, y);
        svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", kRight + 56, y + 4, escaped(curve.name));
        y += 22;
    }
    return svg;
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string svgOf(const Plot& plot) {
    std::vector<double> xs, ys;
    for (const PlotCurve& curve : plot.curves)
        for (const PlotPoint& p : curve.points)
            if (drawable(p)) {
                xs.push_back(p.x);
                ys.push_back(p.y);
            }
    const Axis x = axisOver(xs, kLeft, kRight);
    const Axis y = axisOver(ys, kBottom, kTop);
    std::string svg =
        fmt::format("<svg id=\"{}\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{} over {}\">\n",
                    escaped(plot.id), kWidth, kHeight, escaped(plot.yTitle), escaped(plot.xTitle));
    svg += frame(plot, x, y) + "\n" + guides(plot, x, y) + "\n";
    for (const PlotCurve& curve : plot.curves) svg += curveText(curve, x, y) + "\n";
    return svg + legend(plot) + "</svg>\n";
}

}  // namespace pellucid::accuracy
