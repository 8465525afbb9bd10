// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/report_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "accuracy/report_plan.h"
#include "accuracy/report_reference.h"
#include "renderer/plan/features.h"

namespace pellucid::accuracy {
namespace {

/// Least-squares slope of y over x. Precondition: at least two different x.
double slope(std::span<const double> x, std::span<const double> y) {
    const double n = static_cast<double>(x.size());
    const double meanX = std::accumulate(x.begin(), x.end(), 0.0) / n;
    const double meanY = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double xx = 0.0;
    double xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - meanX) * (x[i] - meanX);
        xy += (x[i] - meanX) * (y[i] - meanY);
    }
    return xy / xx;
}

bool jumps(const TransferFunction1D& function) {
    for (std::size_t i = 1; i < function.points.size(); ++i)
        if (function.points[i].value == function.points[i - 1].value) return true;
    return false;
}

/// Below this an error says nothing of the integrator: the reference's own, that of ended rays, and float
/// roundings; with VTK's 8-bit frame buffer twice the RMSE of rounding to it, 1 / (255 sqrt 12).
double floorOf(const ReportData& data, const ReportSetting& setting, const Scene& scene) {
    double bound = 0.0;
    for (const ReferenceFacts& reference : data.references)
        if (reference.kind == referenceOf(setting, scene)) bound = reference.reachedBound;
    const double output = setting.renderer == "vtk-gpu" ? 2.0 / (255.0 * std::sqrt(12.0)) : 2e-6;
    // A bound is a largest error; the RMSE beside it is smaller still.
    return std::max({bound, kReportTermination, output});
}

void setOrder(ReportSeries& series, const ReportData& data, const Scene& scene) {
    const ReportSetting& setting = data.measurements[series.members.front()].setting;
    if (setting.tolerance) {
        series.remark = "has no step: see tolerances";
        return;
    }
    if (!isPeer(setting) && usesTransferFunction(scene.mode)) {
        series.theory = theoreticalOrder(setting.integrator);
    }
    std::vector<StepError> curve;
    for (const std::size_t i : series.members)
        curve.push_back({data.measurements[i].stepMm, data.measurements[i].rmse});
    series.order = observedOrder(curve, floorOf(data, setting, scene));
    if (!series.order.order) {
        series.remark =
            fmt::format("not measurable: fewer than two errors above {:.1e}", floorOf(data, setting, scene));
    } else if (setting.renderer == "vtk-fixed-point") {
        series.remark = "15 bits: each step adds roundings, so small steps are no better";
    } else if (setting.renderer == "vtk-gpu") {
        series.remark = "rays begin and end on whole steps; 8-bit frame buffer";
    } else if (setting.accumulation != Accumulation::Float32) {
        series.remark = "limited by the accumulation format";
        series.theory.reset();
    } else if (setting.jitter) {
        series.remark = "jitter turns part of the error into noise";
        series.theory.reset();
    } else if (series.theory && *series.order.order < *series.theory - 0.15) {
        const std::string why = unsmoothness(scene, setting.filter);
        series.remark = "not smooth: " + (why.empty() ? "steps not fine enough to see the order" : why);
        if (renderer::usesPreintegration(setting.integrator))
            series.remark += "; or its table's resolution, which short steps do not better";
    }
}

}  // namespace

ObservedOrder observedOrder(std::vector<StepError> curve, double floor) {
    std::erase_if(curve, [floor](const StepError& p) { return !(p.error > floor && p.step > 0.0); });
    std::sort(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.step < b.step; });
    if (curve.size() < 2) return {};
    std::vector<double> x{std::log(curve[0].step)};
    std::vector<double> y{std::log(curve[0].error)};
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const double nextX = std::log(curve[i].step);
        const double nextY = std::log(curve[i].error);
        const double local = (nextY - y.back()) / (nextX - x.back());
        if (i > 1 && std::abs(local - slope(x, y)) > 0.5) break;
        x.push_back(nextX);
        y.push_back(nextY);
    }
    return {slope(x, y), static_cast<int>(x.size())};
}

std::optional<double> theoreticalOrder(Integrator integrator) {
    switch (integrator) {
        case Integrator::Riemann:
            return 1.0;
        case Integrator::Simpson:
        case Integrator::GaussLegendre:
            return 4.0;
        case Integrator::Adaptive:
        case Integrator::Importance:
            return std::nullopt;
        default:
            return 2.0;
    }
}

std::string unsmoothness(const Scene& scene, Filter filter) {
    std::vector<std::string> reasons;
    if (usesTransferFunction(scene.mode) && !scene.volumes.empty() &&
        scene.volumes.front().transferFunction) {
        const TransferFunction1D& function = *scene.volumes.front().transferFunction;
        if (jumps(function))
            reasons.emplace_back("the transfer function jumps");
        else if (function.points.size() > 1)
            reasons.emplace_back("the transfer function has kinks");
    }
    if (fieldOf(filter) == Filter::Nearest)
        reasons.emplace_back("the field jumps from voxel to voxel");
    else if (fieldOf(filter) == Filter::Trilinear)
        reasons.emplace_back("the field has kinks between cells");
    std::string text;
    for (const std::string& reason : reasons) text += (text.empty() ? "" : ", ") + reason;
    return text;
}

std::vector<std::size_t> paretoFront(std::span<const TimeError> points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return points[a].ms != points[b].ms ? points[a].ms < points[b].ms : points[a].error < points[b].error;
    });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
    return front;
}

std::optional<TimeToError> timeToError(std::span<const TimeError> curve, double level) {
    std::optional<TimeToError> best;
    std::size_t cheapest = 0;
    for (std::size_t i = 1; i < curve.size(); ++i)
        if (curve[i].ms < curve[cheapest].ms) cheapest = i;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (!(curve[i].error <= level)) continue;
        TimeToError here{curve[i].ms, i == cheapest};
        // From a coarser step that is worse to this one; a slower coarse step is no way to get there.
        if (i > 0 && curve[i - 1].error > level && curve[i - 1].ms < curve[i].ms && curve[i].error > 0.0) {
            const double share =
                std::log(curve[i - 1].error / level) / std::log(curve[i - 1].error / curve[i].error);
            here = {curve[i - 1].ms * std::pow(curve[i].ms / curve[i - 1].ms, share), false};
        }
        if (!best || here.ms < best->ms) best = here;
    }
    return best;
}

double predictedStall(Accumulation accumulation, double layerOpacity, int layers) {
    const double exact = -std::expm1(layers * std::log1p(-layerOpacity));
    const auto stall = [&](double halfUnit) { return std::clamp(1.0 - halfUnit / layerOpacity, 0.0, exact); };
    switch (accumulation) {
        case Accumulation::Half:
            return stall(0x1p-12);
        case Accumulation::EightBit:
            return stall(0.5 / 255.0);
        case Accumulation::Float32:
            break;
    }
    return exact;
}

ReportAnalysis analyse(const ReportData& data, const Scene& scene) {
    ReportAnalysis analysis;
    for (std::size_t i = 0; i < data.measurements.size(); ++i) {
        const std::string name = seriesName(data.measurements[i].setting);
        auto found = std::find_if(analysis.series.begin(), analysis.series.end(),
                                  [&](const ReportSeries& series) { return series.name == name; });
        if (found == analysis.series.end()) found = analysis.series.insert(found, {name, {}, {}, {}, {}, {}});
        found->members.push_back(i);
    }
    for (ReportSeries& series : analysis.series) {
        setOrder(series, data, scene);
        std::vector<TimeError> curve;
        for (const std::size_t i : series.members)
            curve.push_back({data.measurements[i].wallMs, data.measurements[i].rmse});
        for (const double level : kErrorLevels) series.timesToError.push_back(timeToError(curve, level));
    }
    for (const Filter filter : data.scope.filters) {
        std::vector<std::size_t> members;
        std::vector<TimeError> points;
        for (std::size_t i = 0; i < data.measurements.size(); ++i) {
            if (data.measurements[i].setting.filter != filter) continue;
            members.push_back(i);
            points.push_back({data.measurements[i].wallMs, data.measurements[i].rmse});
        }
        std::vector<std::size_t>& front = analysis.fronts.emplace_back();
        for (const std::size_t i : paretoFront(points)) front.push_back(members[i]);
    }
    return analysis;
}

}  // namespace pellucid::accuracy
