// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/shown_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/plan/preintegration.h"
#include "renderer/plan/transfer_table.h"

namespace pellucid::renderer {

namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Adds an interval to ascending ones; those that meet become one.
void append(std::vector<ValueRange>& found, ValueRange range) {
    if (!found.empty() && range.lo <= found.back().hi)
        found.back().hi = std::max(found.back().hi, range.hi);
    else
        found.push_back(range);
}

/// Intervals on which the function's extinction exceeds `least`, or reaches it when that is above 0. Closed,
/// so a little more than that at steps and where it starts to rise.
std::vector<ValueRange> support(const TransferFunction1D& function, double least) {
    const auto shows = [least](double extinction) {
        return least > 0.0 ? extinction >= least : extinction > 0.0;
    };
    const auto& points = function.points;
    std::vector<ValueRange> found;
    if (shows(points.front().extinction)) append(found, {-kEndless, points.front().value});
    for (std::size_t i = 1; i < points.size(); ++i) {
        const auto& a = points[i - 1];
        const auto& b = points[i];
        if (!shows(a.extinction) && !shows(b.extinction)) continue;
        // The piece is linear: it crosses the threshold once where only one end shows.
        const double f = (least - a.extinction) / (b.extinction - a.extinction);
        const double crossing = std::clamp(a.value + f * (b.value - a.value), a.value, b.value);
        append(found, {shows(a.extinction) ? a.value : crossing, shows(b.extinction) ? b.value : crossing});
    }
    if (shows(points.back().extinction)) append(found, {points.back().value, kEndless});
    return found;
}

/// Distance of the entries of the coarsest table that the scene's integrator reads the function from.
double coarsestEntry(const Scene& scene, const Plan& plan, const VolumeFacts& facts) {
    const TableLayout& table = plan.table;
    if (!(table.hi > table.lo)) return 0.0;
    int size = table.size > 0 ? table.size : std::numeric_limits<int>::max();
    if (usesPreintegration(plan.features.integrator))
        size = std::min(size, layoutPreintegration(scene, plan, facts).size);
    if (usesRunningIntegrals(plan.features.integrator)) size = std::min(size, integralTableSize(facts.type));
    return (table.hi - table.lo) / (size - 1);
}

std::vector<ValueRange> shownByFunction(const Scene& scene, const Plan& plan, const VolumeFacts& facts) {
    // A function that is nowhere dense shows nothing, whatever its points say.
    if (!(scene.densityScale > 0.0)) return {};
    const auto& function = *scene.volumes.front().transferFunction;
    // As the shader's threshold, a hair lower than asked.
    const double least = scene.mode == Mode::FirstHit
                             ? extinctionFromOpacity(scene.hitOpacity) / scene.densityScale * (1.0 - 1e-5)
                             : 0.0;
    std::vector<ValueRange> shown = support(function, least);
    // An entry is seen up to the next one; the quarter is for units that round their interpolation weights.
    const double reach = 1.25 * coarsestEntry(scene, plan, facts);
    std::vector<ValueRange> wide;
    for (const auto& range : shown) append(wide, {range.lo - reach, range.hi + reach});
    return wide;
}

}  // namespace

FilterReach reachOf(Filter filter) {
    const double overshoot = reachableValues({0.0, 1.0}, filter).hi - 1.0;
    switch (filter) {
        case Filter::Nearest:
        case Filter::Trilinear:
        case Filter::TrilinearExact:
            return {1, overshoot};
        case Filter::TricubicBSpline:
        case Filter::TricubicBSplineDeBoor:
        case Filter::TricubicBSplineLut:
        case Filter::CatmullRom:
            return {2, overshoot};
        case Filter::Lanczos3:
            break;
    }
    return {3, overshoot};
}

std::vector<ValueRange> shownValues(const Scene& scene, const Plan& plan, const VolumeFacts& facts) {
    const auto& item = scene.volumes.front();
    // MIP and MinIP compare stored values: where those run against the physical ones, ends change places.
    const bool upwards = !facts.descending;
    switch (scene.mode) {
        case Mode::Mip:
        case Mode::MinIp: {
            // Values beyond the end of the window from which the extremum is sought look like that end
            // itself.
            const double lo = item.window->level - 0.5 * item.window->width;
            const double hi = item.window->level + 0.5 * item.window->width;
            if ((scene.mode == Mode::Mip) == upwards) return {{lo, kEndless}};
            return {{-kEndless, hi}};
        }
        case Mode::Isosurface:
            if (upwards) return {{*item.isovalue, kEndless}};
            return {{-kEndless, *item.isovalue}};
        default:
            return shownByFunction(scene, plan, facts);
    }
}

}  // namespace pellucid::renderer
