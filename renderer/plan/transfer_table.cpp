// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/transfer_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "scene/image.h"

namespace pellucid::renderer {

namespace {

constexpr int kMaxEntries = 16384;  // GL_MAX_TEXTURE_SIZE guaranteed by OpenGL 4.5
constexpr double kWanted = 1.0 / 16384.0;

OpticalSample interpolated(const OpticalSample& a, const OpticalSample& b, double f) {
    return {a.color * (1.0 - f) + b.color * f, a.extinction * (1.0 - f) + b.extinction * f};
}

double difference(const OpticalSample& a, const OpticalSample& b, double voxelInUnits) {
    const double alphaA = -std::expm1(-a.extinction * voxelInUnits);
    const double alphaB = -std::expm1(-b.extinction * voxelInUnits);
    double worst = std::abs(alphaA - alphaB);
    for (int channel = 0; channel < 3; ++channel)
        worst = std::max(worst, std::abs(alphaA * a.color[channel] - alphaB * b.color[channel]));
    return worst;
}

double worstError(const TransferFunction1D& function, double lo, double hi, int size, double voxelInUnits) {
    if (!(hi > lo)) return 0.0;
    const double spacing = (hi - lo) / (size - 1);
    double worst = 0.0;
    for (const auto& point : function.points) {
        if (point.value < lo || point.value > hi) continue;
        const double x = (point.value - lo) / spacing;
        const double i = std::min(std::floor(x), static_cast<double>(size - 2));
        const auto table = interpolated(evaluate(function, lo + i * spacing),
                                        evaluate(function, lo + (i + 1) * spacing), x - i);
        // The point itself covers both sides of a step: each point of a pair at one value is visited.
        worst = std::max(worst, difference(table, {point.color, point.extinction}, voxelInUnits));
    }
    return worst;
}

/// Sizes to try: powers of two, and the one that puts an entry on every integer (control points mostly are
/// integers).
std::vector<int> candidates(double lo, double hi) {
    std::vector<int> sizes{256, 512, 1024, 2048, 4096, 8192, kMaxEntries};
    if (lo == std::floor(lo) && hi == std::floor(hi) && hi - lo < kMaxEntries) {
        const int onIntegers = static_cast<int>(hi - lo) + 1;
        sizes.insert(std::upper_bound(sizes.begin(), sizes.end(), onIntegers), std::max(onIntegers, 2));
    }
    return sizes;
}

}  // namespace

TableLayout layoutTable(const TransferFunction1D& function, ValueRange values, double voxelInUnits) {
    TableLayout layout;
    layout.lo = std::max(values.lo, function.points.front().value);
    layout.hi = std::min(values.hi, function.points.back().value);
    // A function that jumps at its first point is another below it: the table must reach there.
    if (const auto& points = function.points;
        points.size() > 1 && points[0].value == points[1].value && values.lo < layout.lo)
        layout.lo = values.lo;
    if (!(layout.hi > layout.lo)) {
        // Nothing varies within reach: all values lie at, before or behind one point.
        const double value = std::clamp(values.lo, std::min(layout.lo, function.points.front().value),
                                        function.points.back().value);
        return {value, value, 2, 0.0};
    }
    // Narrower than float can tell the values apart, the ends would only overflow the map to entries.
    const double least = std::ldexp(values.hi - values.lo, -20);
    if (layout.hi - layout.lo < least) {
        layout.lo = std::midpoint(layout.lo, layout.hi) - 0.5 * least;
        layout.hi = layout.lo + least;
    }
    double best = std::numeric_limits<double>::infinity();
    for (int size : candidates(layout.lo, layout.hi)) {
        const double error = worstError(function, layout.lo, layout.hi, size, voxelInUnits);
        const double area = error / (size - 1);
        if (area < best) {
            best = area;
            layout.size = size;
            layout.worstError = error;
        }
        if (error <= kWanted) break;
    }
    return layout;
}

TransferFunction1D visiblePart(const TransferFunction1D& function) {
    constexpr double kMargin = 1.0 / 64.0;
    const auto& points = function.points;
    const auto shows = [](const TransferPoint& point) { return point.extinction > 0.0; };
    const auto first = std::find_if(points.begin(), points.end(), shows);
    if (first == points.end()) return function;
    const auto last = std::find_if(points.rbegin(), points.rend(), shows).base() - 1;
    TransferFunction1D visible = function;
    visible.points.assign(first == points.begin() ? first : first - 1,
                          last + 1 == points.end() ? last + 1 : last + 2);
    auto& kept = visible.points;
    const double width = kept.back().value - kept.front().value;
    // On to an integer, so that candidates() finds entries on all of them.
    const auto beyond = [&](double value, double direction) {
        const double moved = value + direction * kMargin * width;
        if (width < 1.0 || value != std::floor(value)) return moved;
        return direction < 0.0 ? std::floor(moved) : std::ceil(moved);
    };
    const bool jumpsUp = first != points.begin() && kept[0].value == kept[1].value;
    const bool jumpsDown = last + 1 != points.end() && kept[kept.size() - 2].value == kept.back().value;
    if (jumpsUp) kept.front().value = beyond(kept.front().value, -1.0);
    if (jumpsDown) kept.back().value = beyond(kept.back().value, 1.0);
    return visible;
}

TransferFunction1D inCompositingSpace(const TransferFunction1D& function, CompositingSpace space) {
    TransferFunction1D converted = function;
    if (space == CompositingSpace::Display) return converted;
    for (auto& point : converted.points) point.color = linearFromDisplay(point.color);
    return converted;
}

ValueRange reachableValues(ValueRange range, Filter filter) {
    // The largest sum of absolute weights in three axes: (5/4)^3 and, half-way between voxels,
    // (71/46)^3.
    constexpr double kLanczosWeights = 71.0 / 46.0;
    double absoluteWeights = 1.0;
    if (filter == Filter::CatmullRom) absoluteWeights = 1.953125;
    if (filter == Filter::Lanczos3) absoluteWeights = kLanczosWeights * kLanczosWeights * kLanczosWeights;
    // Weights sum to 1, so half of what is above 1 is negative.
    const double overshoot = 0.5 * (absoluteWeights - 1.0) * (range.hi - range.lo);
    return {range.lo - overshoot, range.hi + overshoot};
}

}  // namespace pellucid::renderer
