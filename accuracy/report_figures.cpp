// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/report_figures.h"

#include <fmt/format.h>

#include "accuracy/report_plan.h"

namespace pellucid::accuracy {
namespace {

using Choose = bool (*)(const ReportSetting& setting, Filter own);

bool isPlain(const ReportSetting& s) {
    return !isPeer(s) && !s.jitter && s.accumulation == Accumulation::Float32;
}
bool isExponential(const ReportSetting& s) {
    return !isPeer(s) && !s.automatic && s.integrator == Integrator::Exponential;
}

/// Peers take the styles after the integrators'.
int styleOf(const ReportSetting& s) {
    if (s.automatic) return 12;
    if (!isPeer(s)) return static_cast<int>(s.integrator);
    if (s.renderer == "vtk-fixed-point") return 10;
    return s.jitter ? 11 : 9;
}

std::string pointLabel(const Measurement& m) {
    return fmt::format("{}: {:.2f} ms, RMSE {:.3g}, max {:.3g}", settingName(m.setting), m.wallMs, m.rmse,
                       m.maxError);
}

template <class Name, class Style>
std::vector<PlotCurve> curvesOf(const ReportData& data, const ReportAnalysis& analysis, Choose choose,
                                bool overStep, const Name& nameOf, const Style& style) {
    std::vector<PlotCurve> curves;
    for (const ReportSeries& series : analysis.series) {
        const ReportSetting& first = data.measurements[series.members.front()].setting;
        if (!choose(first, data.scope.filters.front()) || (overStep && first.tolerance)) continue;
        PlotCurve curve{
            nameOf(first), {}, style(first, static_cast<int>(curves.size())), isPeer(first) || first.jitter};
        for (const std::size_t i : series.members) {
            const Measurement& m = data.measurements[i];
            curve.points.push_back({overStep ? m.setting.stepVoxels : m.wallMs, m.rmse, pointLabel(m)});
        }
        curves.push_back(std::move(curve));
    }
    return curves;
}

constexpr const char* kTime = "time of a warm frame, ms (wall clock, median)";
constexpr const char* kError = "RMSE against the reference";

std::vector<double> levels() {
    return {std::begin(kErrorLevels), std::end(kErrorLevels)};
}

std::string integratorOrPeer(const ReportSetting& s) {
    std::string text = methodName(s);
    if (s.jitter) text += ", jitter";
    return text;
}

int ownStyle(const ReportSetting& s, int) {
    return styleOf(s);
}
/// Formats, filters and jitter have no colour of their own: well apart ones in their order.
int styleInTurn(const ReportSetting&, int index) {
    constexpr int kStyles[] = {1, 5, 3, 6, 0, 4, 7, 2};
    return kStyles[index % 8];
}

}  // namespace

std::vector<ReportFigure> reportFigures(const ReportData& data, const ReportAnalysis& analysis) {
    const char* own = name(data.scope.filters.front());
    std::vector<ReportFigure> figures;
    const auto add = [&](ReportFigure figure, std::size_t least) {
        if (figure.plot.curves.size() >= least) figures.push_back(std::move(figure));
    };
    add({"Work and precision",
         fmt::format("How long a picture takes against how wrong it is, filter {}, one point a step or "
                     "tolerance. Further left "
                     "is faster, further down is more exact; the dashed lines are the error levels of the "
                     "next table.",
                     own),
         {"work-precision",
          kTime,
          kError,
          curvesOf(
              data, analysis,
              [](const ReportSetting& s, Filter f) { return isPeer(s) || (isPlain(s) && s.filter == f); },
              false, integratorOrPeer, ownStyle),
          levels(),
          {}}},
        1);
    add({"Convergence",
         "The error over the step. The thin lines have the slopes of orders 1, 2 and 4: a curve as steep as "
         "a line "
         "has that order.",
         {"convergence",
          "step, voxels",
          kError,
          curvesOf(
              data, analysis,
              [](const ReportSetting& s, Filter f) { return isPeer(s) || (isPlain(s) && s.filter == f); },
              true, integratorOrPeer, ownStyle),
          {},
          {1.0, 2.0, 4.0}}},
        1);
    add({"Accumulation formats",
         "The exponential integrator, its colour and opacity kept in 32-bit float, half float or 8 bits. "
         "Below, small steps make a low "
         "format worse: each adds less than it can hold.",
         {"formats",
          "step, voxels",
          kError,
          curvesOf(
              data, analysis,
              [](const ReportSetting& s, Filter f) { return isExponential(s) && !s.jitter && s.filter == f; },
              true, [](const ReportSetting& s) { return std::string(name(s.accumulation)); }, styleInTurn),
          levels(),
          {}}},
        2);
    add({"Filters",
         "The exponential integrator with each reconstruction filter, each against its own reference: a "
         "filter is another field, "
         "not an error.",
         {"filters",
          kTime,
          kError,
          curvesOf(
              data, analysis, [](const ReportSetting& s, Filter) { return isExponential(s) && isPlain(s); },
              false, [](const ReportSetting& s) { return std::string(name(s.filter)); }, styleInTurn),
          levels(),
          {}}},
        2);
    add({"Jitter",
         "The exponential integrator with and without ray starts shifted by blue noise: rings become noise, "
         "and the error itself "
         "changes little.",
         {"jitter",
          kTime,
          kError,
          curvesOf(
              data, analysis,
              [](const ReportSetting& s, Filter f) {
                  return isExponential(s) && s.accumulation == Accumulation::Float32 && s.filter == f;
              },
              false, integratorOrPeer, styleInTurn),
          levels(),
          {}}},
        2);
    return figures;
}

}  // namespace pellucid::accuracy
