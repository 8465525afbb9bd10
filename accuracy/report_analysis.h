// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "accuracy/report_data.h"

/// Conclusions from measurements: pure functions.
namespace pellucid::accuracy {

/// One point of a convergence curve.
struct StepError {
    double step = 0.0;  ///< > 0.
    double error = 0.0;
};

struct ObservedOrder {
    std::optional<double> order;  ///< Nothing where fewer than two points lie above the floor.
    int points = 0;               ///< How many of the finest points it rests on.
};

/// Least-squares slope of log error over log step through the finest points above `floor` that lie on one
/// line: coarser points are taken in while their local slope is within 0.5 of the slope so far.
[[nodiscard]] ObservedOrder observedOrder(std::vector<StepError> curve, double floor);

/// Of a smooth integrand; nothing for the adaptive rule, which has no step (docs/equations.md, 7 to 13).
[[nodiscard]] std::optional<double> theoreticalOrder(Integrator integrator);

/// Why less than the theory is seen: what in this scene is not smooth. Empty when all is.
[[nodiscard]] std::string unsmoothness(const Scene& scene, Filter filter);

struct TimeError {
    double ms = 0.0;     ///< > 0.
    double error = 0.0;  ///< >= 0.
};

/// Indices of the points no other point beats in both time and error, by time. Of equal points the first is
/// kept.
[[nodiscard]] std::vector<std::size_t> paretoFront(std::span<const TimeError> points);

struct TimeToError {
    double ms = 0.0;
    bool atMost = false;  ///< The cheapest point already is better than asked: the time is an upper bound.
};

/// Earliest time at which the curve (in the order of its steps, coarse to fine) is at or below `level`,
/// straight between its points in the logarithms of both; nothing when it never is.
[[nodiscard]] std::optional<TimeToError> timeToError(std::span<const TimeError> curve, double level);

/// Opacity at which n layers of opacity a stop growing in a format: a (1 - A) is half a unit of A. 8-bit
/// units are 1/255; a half float below 1 has units of 2^-11.
[[nodiscard]] double predictedStall(Accumulation accumulation, double layerOpacity, int layers);

/// One curve of the report with what follows from it.
struct ReportSeries {
    std::string name;                  ///< seriesName().
    std::vector<std::size_t> members;  ///< Indices of measurements, coarse to fine.
    ObservedOrder order;
    std::optional<double> theory;
    std::string remark;  ///< Why the order is below theory, or why there is none.
    std::vector<std::optional<TimeToError>> timesToError;  ///< For each of kErrorLevels.
};

inline constexpr double kErrorLevels[] = {0.02, 0.01, 0.005, 0.002, 0.001};

struct ReportAnalysis {
    std::vector<ReportSeries> series;
    std::vector<std::vector<std::size_t>> fronts;  ///< For each filter of the scope: indices of measurements.
};

[[nodiscard]] ReportAnalysis analyse(const ReportData& data, const Scene& scene);

}  // namespace pellucid::accuracy
