// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pellucid::accuracy {

struct PlotPoint {
    double x = 0.0;
    double y = 0.0;
    std::string label;  ///< Shown when the pointer rests on the point.
};

struct PlotCurve {
    std::string name;
    std::vector<PlotPoint> points;  ///< Joined in this order; those not above 0 are left out.
    int style = 0;                  ///< Colour and marker; the same number looks the same in every plot.
    bool dashed = false;
};

struct Plot {
    std::string id;
    std::string xTitle, yTitle;
    std::vector<PlotCurve> curves;
    std::vector<double> levels;  ///< Horizontal lines across the plot.
    std::vector<double> slopes;  ///< Guide lines y ~ x^slope in a corner, each labelled with its slope.
};

/// Both axes logarithmic, with a legend; an <svg> element that refers to nothing outside.
[[nodiscard]] std::string svgOf(const Plot& plot);

/// For text and attributes of HTML and SVG.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace pellucid::accuracy
