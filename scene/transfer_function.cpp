// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/transfer_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/check.h"

namespace pellucid {

namespace {

constexpr std::size_t kMaxPoints = 65536;

/// Where x lies between a and b in [0, 1], also when b - a overflows. Precondition: a <= x < b.
double fractionBetween(double a, double b, double x) {
    const double span = b - a;
    return std::isfinite(span) ? (x - a) / span : (x / 2 - a / 2) / (b / 2 - a / 2);
}

/// Largest |opacity of the extinction-linear segment - opacity-linear segment| between two extinctions. With
/// t(s) = t0 + d s the difference 1 - exp(-t(s)) - (a0 + (a1 - a0) s) vanishes at both ends and has its only
/// extremum where d exp(-t(s)) = a1 - a0.
double segmentDeviation(double t0, double t1) {
    const double d = t1 - t0;
    const double a0 = opacityFromExtinction(t0), a1 = opacityFromExtinction(t1);
    if (d == 0.0 || a0 == a1) return 0.0;
    const double s = std::clamp((std::log(d / (a1 - a0)) - t0) / d, 0.0, 1.0);
    return std::abs(opacityFromExtinction(t0 + d * s) - std::lerp(a0, a1, s));
}

/// Appends the segment from a to b without a, halved in value and opacity until it is straight enough.
void appendFollowing(const TransferPoint& a, const TransferPoint& b, double bound, int depth,
                     std::vector<TransferPoint>& points) {
    constexpr int kMaxDepth = 12;
    TransferPoint middle;
    middle.value = a.value / 2 + b.value / 2;
    const bool divides = middle.value > a.value && middle.value < b.value;
    if (divides && depth < kMaxDepth && segmentDeviation(a.extinction, b.extinction) > bound) {
        middle.color = (a.color + b.color) / 2.0;
        middle.extinction = extinctionFromOpacity(
            (opacityFromExtinction(a.extinction) + opacityFromExtinction(b.extinction)) / 2);
        appendFollowing(a, middle, bound, depth + 1, points);
        appendFollowing(middle, b, bound, depth + 1, points);
    } else {
        points.push_back(b);
    }
}

}  // namespace

double extinctionFromOpacity(double alpha) {
    PELLUCID_CHECK(alpha >= 0.0 && alpha <= 1.0);
    return std::min(-std::log1p(-alpha), kOpaqueExtinction);
}

double opacityFromExtinction(double tau) {
    PELLUCID_CHECK(tau >= 0.0);
    return tau >= kOpaqueExtinction ? 1.0 : -std::expm1(-tau);
}

Result<void> validate(const TransferFunction1D& function) {
    const auto& points = function.points;
    const auto refuse = [](const std::string& where, const std::string& what) {
        return fail(ErrorCode::InvalidArgument, fmt::format("/points{}: {}", where, what));
    };
    if (points.empty() || points.size() > kMaxPoints)
        return refuse("", fmt::format("found {} points, allowed are 1 to {}", points.size(), kMaxPoints));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const TransferPoint& point = points[i];
        if (!std::isfinite(point.value))
            return refuse(fmt::format("/{}/value", i),
                          fmt::format("found {}, allowed is a finite number", point.value));
        if (i > 0 && point.value < points[i - 1].value)
            return refuse(fmt::format("/{}/value", i),
                          fmt::format("found {} after {}, allowed are values that do not descend",
                                      point.value, points[i - 1].value));
        for (int c = 0; c < 3; ++c)
            if (!(point.color[c] >= 0.0 && point.color[c] <= 1.0))
                return refuse(fmt::format("/{}/color/{}", i, c),
                              fmt::format("found {}, allowed is a number in [0, 1]", point.color[c]));
        if (!(point.extinction >= 0.0 && point.extinction <= kLargestExtinction))
            return refuse(fmt::format("/{}/extinction", i),
                          fmt::format("found {}, allowed is a number in [0, 1e30]", point.extinction));
    }
    return {};
}

OpticalSample evaluate(const TransferFunction1D& function, double value) {
    const auto& points = function.points;
    if (std::isnan(value)) return {points.front().color, points.front().extinction};
    // The first point above the value: behind all points at the value itself, so the later one of a step
    // holds.
    const auto above = std::upper_bound(points.begin(), points.end(), value,
                                        [](double v, const TransferPoint& point) { return v < point.value; });
    if (above == points.begin()) return {above->color, above->extinction};
    const TransferPoint& a = *(above - 1);
    if (above == points.end()) return {a.color, a.extinction};
    const double t = fractionBetween(a.value, above->value, value);
    OpticalSample sample;
    for (int c = 0; c < 3; ++c) sample.color[c] = std::lerp(a.color[c], above->color[c], t);
    sample.extinction = std::lerp(a.extinction, above->extinction, t);
    return sample;
}

std::vector<glm::vec4> bakeTable(const TransferFunction1D& function, double lo, double hi, int n) {
    PELLUCID_CHECK(n >= 2);
    std::vector<glm::vec4> table(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
        const double fraction = static_cast<double>(i) / (n - 1);
        const OpticalSample sample = evaluate(function, std::lerp(lo, hi, fraction));
        table[static_cast<std::size_t>(i)] =
            glm::vec4(glm::vec3(sample.color), static_cast<float>(sample.extinction));
    }
    return table;
}

TransferFunction1D rampFunction(double lo, double hi, double opacityAtHi) {
    PELLUCID_CHECK(lo <= hi);
    TransferFunction1D function;
    function.name = "ramp";
    function.points = {{lo, glm::dvec3(0.0), 0.0}, {hi, glm::dvec3(1.0), extinctionFromOpacity(opacityAtHi)}};
    return function;
}

TransferFunction1D followingOpacity(const TransferFunction1D& function, double bound) {
    PELLUCID_CHECK(bound > 0.0);
    TransferFunction1D result = function;
    result.points.resize(1);
    for (std::size_t i = 1; i < function.points.size(); ++i)
        appendFollowing(function.points[i - 1], function.points[i], bound, 0, result.points);
    return result;
}

}  // namespace pellucid
