// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/dicom_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>

namespace pellucid::io {
namespace {

constexpr double kRoundingMm = 0.02;        // Positions with two decimals; derived at placeSlices.
constexpr double kRoundingOfStep = 0.25;    // Of the step, for steps of the order of the rounding itself.
constexpr double kOffGridOfStep = 0.05;     // Derived at placeSlices.
constexpr double kUnitTolerance = 1e-3;     // Direction cosines come with three decimals or more.
constexpr double kCornerTolerancePx = 0.1;  // Of a pixel, at the corner farthest from the position.
constexpr double kShownTiltDeg = 0.1;       // 0.02 mm aside on 10 mm: rounding of positions, not a tilt.

tl::unexpected<Error> inconsistent(std::string what) {
    return fail(ErrorCode::Inconsistent, std::move(what));
}

std::string pointText(glm::dvec3 p) {
    return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x, p.y, p.z);
}

bool isFinite(glm::dvec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double roundingMm(double stepMm) {
    return std::min(kRoundingMm, kRoundingOfStep * stepMm);
}
double allowedMm(double stepMm) {
    return std::max(roundingMm(stepMm), kOffGridOfStep * stepMm);
}

glm::dvec3 normalOf(const SlicePlacement& slice) {
    return glm::normalize(glm::cross(slice.rowDirection, slice.columnDirection));
}

Result<void> checkSlice(const SlicePlacement& slice) {
    const bool finite = isFinite(slice.positionMm) && isFinite(slice.rowDirection) &&
                        isFinite(slice.columnDirection) && std::isfinite(slice.spacingMm.x) &&
                        std::isfinite(slice.spacingMm.y);
    if (!finite) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("{}: position, orientation or spacing is not a finite number", slice.name));
    }
    if (slice.spacingMm.x <= 0.0 || slice.spacingMm.y <= 0.0 || slice.size.x < 1 || slice.size.y < 1) {
        return fail(
            ErrorCode::Corrupt,
            fmt::format("{}: {} x {} pixels with a spacing of {} x {} mm (columns x rows) are no slice",
                        slice.name, slice.size.x, slice.size.y, slice.spacingMm.x, slice.spacingMm.y));
    }
    const double rowLength = glm::length(slice.rowDirection);
    const double columnLength = glm::length(slice.columnDirection);
    const double cosine = glm::dot(slice.rowDirection, slice.columnDirection);
    if (std::abs(rowLength - 1.0) > kUnitTolerance || std::abs(columnLength - 1.0) > kUnitTolerance ||
        std::abs(cosine) > kUnitTolerance) {
        return fail(
            ErrorCode::Corrupt,
            fmt::format(
                "{}: the directions of rows and columns have lengths {:.6g} and {:.6g} and the cosine "
                "{:.6g} between them, which should be 1, 1 and 0",
                slice.name, rowLength, columnLength, cosine));
    }
    return {};
}

/// How far, in pixels, the far corner moves when `b` is placed with the axes of `a`.
double cornerShiftPx(const SlicePlacement& a, const SlicePlacement& b) {
    const auto far = [](const SlicePlacement& s) {
        return s.rowDirection * (s.spacingMm.x * s.size.x) + s.columnDirection * (s.spacingMm.y * s.size.y);
    };
    const auto side = [](const SlicePlacement& s) { return s.rowDirection * (s.spacingMm.x * s.size.x); };
    const double shiftMm = std::max(glm::length(far(a) - far(b)), glm::length(side(a) - side(b)));
    return shiftMm / std::min(a.spacingMm.x, a.spacingMm.y);
}

Result<void> checkAlike(std::span<const SlicePlacement> slices) {
    const SlicePlacement& first = slices.front();
    for (const SlicePlacement& slice : slices) {
        if (auto checked = checkSlice(slice); !checked) return checked;
        if (slice.size != first.size) {
            return inconsistent(fmt::format("slices differ in size: {} has {} x {} pixels, {} has {} x {}",
                                            first.name, first.size.x, first.size.y, slice.name, slice.size.x,
                                            slice.size.y));
        }
        if (cornerShiftPx(first, slice) <= kCornerTolerancePx) continue;
        const double turnedDeg = glm::degrees(
            std::acos(std::clamp(std::min({glm::dot(first.rowDirection, slice.rowDirection),
                                           glm::dot(first.columnDirection, slice.columnDirection)}),
                                 -1.0, 1.0)));
        return inconsistent(
            fmt::format("slices differ in orientation or pixel spacing: {} has {:.6g} x {:.6g} mm (columns x "
                        "rows), {} has "
                        "{:.6g} x {:.6g} mm and is turned by {:.3g} degrees",
                        first.name, first.spacingMm.x, first.spacingMm.y, slice.name, slice.spacingMm.x,
                        slice.spacingMm.y, turnedDeg));
    }
    return {};
}

/// Slices in order along the normal, with what messages need of them.
struct Line {
    std::span<const SlicePlacement> slices;
    std::vector<std::size_t> order;
    glm::dvec3 normal{0};

    [[nodiscard]] std::size_t count() const { return order.size(); }
    [[nodiscard]] const SlicePlacement& at(std::size_t k) const { return slices[order[k]]; }
    /// Along the normal from slice k to slice k + 1.
    [[nodiscard]] double step(std::size_t k) const {
        return glm::dot(at(k + 1).positionMm - at(k).positionMm, normal);
    }
};

Line ordered(std::span<const SlicePlacement> slices) {
    Line line{slices, std::vector<std::size_t>(slices.size()), normalOf(slices.front())};
    std::iota(line.order.begin(), line.order.end(), std::size_t{0});
    const auto height = [&](std::size_t i) {
        return glm::dot(slices[i].positionMm - slices[0].positionMm, line.normal);
    };
    std::stable_sort(line.order.begin(), line.order.end(),
                     [&](std::size_t a, std::size_t b) { return height(a) < height(b); });
    return line;
}

/// The lower median: with one missing slice among three it is the step, not the gap.
double medianStep(const Line& line) {
    std::vector<double> steps(line.count() - 1);
    for (std::size_t k = 0; k < steps.size(); ++k) steps[k] = line.step(k);
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

/// Steps that are no steps: less than rounding, measured against the largest.
Result<void> checkDistinct(const Line& line) {
    double largest = 0.0;
    for (std::size_t k = 0; k + 1 < line.count(); ++k) largest = std::max(largest, line.step(k));
    const double same = largest > 0.0 ? std::min(0.01, 0.1 * largest) : 0.01;
    std::size_t positions = 1;
    std::optional<std::size_t> twice;
    for (std::size_t k = 0; k + 1 < line.count(); ++k) {
        if (line.step(k) > same) {
            ++positions;
        } else if (!twice) {
            twice = k;
        }
    }
    if (!twice) return {};
    return inconsistent(
        fmt::format("{} slices lie at {} position{} along their normal: {} and {} are both at {} mm. Images "
                    "of several times, "
                    "echoes or reconstructions in one series are not one volume",
                    line.count(), positions, positions == 1 ? "" : "s", line.at(*twice).name,
                    line.at(*twice + 1).name, pointText(line.at(*twice).positionMm)));
}

double tiltDeg(glm::dvec3 step, glm::dvec3 normal) {
    return glm::degrees(std::acos(std::clamp(glm::dot(step, normal) / glm::length(step), -1.0, 1.0)));
}

/// "13 x 4.002 mm, 13 x 6.999 mm, 1 x 1.081 mm": the commonest first, at most five.
std::string stepsText(const Line& line) {
    std::vector<double> steps(line.count() - 1);
    for (std::size_t k = 0; k < steps.size(); ++k) steps[k] = line.step(k);
    std::sort(steps.begin(), steps.end());
    std::vector<std::pair<std::size_t, double>> groups;  // Count, smallest.
    for (const double step : steps) {
        if (groups.empty() || step - groups.back().second > allowedMm(groups.back().second))
            groups.push_back({0, step});
        ++groups.back().first;
    }
    std::stable_sort(groups.begin(), groups.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(groups.size(), 5); ++i) {
        text += fmt::format("{}{} x {:.4g} mm", i > 0 ? ", " : "", groups[i].first, groups[i].second);
    }
    return groups.size() > 5 ? text + ", ..." : text;
}

/// Why the slices do not step evenly; called when they do not.
tl::unexpected<Error> unevenSteps(const Line& line) {
    const double usual = medianStep(line);
    std::size_t smallest = 0;
    std::size_t largest = 0;
    std::size_t gaps = 0;
    std::optional<std::size_t> firstGap;
    bool onlyGaps = true;
    for (std::size_t k = 0; k + 1 < line.count(); ++k) {
        const double step = line.step(k);
        if (step < line.step(smallest)) smallest = k;
        if (step > line.step(largest)) largest = k;
        if (std::abs(step - usual) <= allowedMm(usual)) continue;
        const double multiple = std::round(step / usual);
        if (multiple < 2.0 || std::abs(step - multiple * usual) > multiple * allowedMm(usual)) {
            onlyGaps = false;
        } else {
            ++gaps;
            if (!firstGap) firstGap = k;
        }
    }
    if (onlyGaps && firstGap) {
        const double gap = line.step(*firstGap);
        const auto missing = static_cast<long long>(std::round(gap / usual)) - 1;
        return inconsistent(fmt::format(
            "{} slice{} missing between {} and {}: they are {:.4g} mm apart where {:.4g} mm is the step{}",
            missing, missing == 1 ? " is" : "s are", line.at(*firstGap).name, line.at(*firstGap + 1).name,
            gap, usual, gaps > 1 ? fmt::format(" ({} such gaps in all)", gaps) : ""));
    }
    const double tilt = tiltDeg(line.at(line.count() - 1).positionMm - line.at(0).positionMm, line.normal);
    return inconsistent(fmt::format(
        "the slices are not evenly spaced: steps along their normal go from {:.4g} mm ({} to {}) to {:.4g} "
        "mm ({} to {}): "
        "{}{}. Such a series is no regular grid",
        line.step(smallest), line.at(smallest).name, line.at(smallest + 1).name, line.step(largest),
        line.at(largest).name, line.at(largest + 1).name, stepsText(line),
        tilt > kShownTiltDeg ? fmt::format("; they step {:.2f} degrees off their normal", tilt) : ""));
}

/// The even step through the first and last position; sets the deviation from it.
Result<glm::dvec3> evenStep(const Line& line, double& worstMm) {
    const glm::dvec3 start = line.at(0).positionMm;
    const auto last = static_cast<double>(line.count() - 1);
    const glm::dvec3 step = (line.at(line.count() - 1).positionMm - start) / last;
    const double alongMm = glm::dot(step, line.normal);
    std::size_t worst = 0;
    double worstAlongMm = 0.0;
    worstMm = 0.0;
    for (std::size_t k = 0; k < line.count(); ++k) {
        const glm::dvec3 off = line.at(k).positionMm - (start + static_cast<double>(k) * step);
        worstAlongMm = std::max(worstAlongMm, std::abs(glm::dot(off, line.normal)));
        if (glm::length(off) > worstMm) {
            worstMm = glm::length(off);
            worst = k;
        }
    }
    if (worstAlongMm > allowedMm(alongMm)) return unevenSteps(line);
    if (worstMm > allowedMm(alongMm)) {
        return inconsistent(fmt::format("{} lies {:.4g} mm beside the line through the first and last slice",
                                        line.at(worst).name, worstMm));
    }
    return step;
}

/// What the files state apart from the positions, compared with them.
void compareStated(const Line& line, SeriesGeometry& geometry, double alongStepMm) {
    const SlicePlacement& first = line.at(0);
    if (geometry.worstOffGridMm > roundingMm(geometry.stepMm)) {
        geometry.warnings.push_back({fmt::format(
            "slices lie up to {:.3g} mm off even steps of {:.6g} mm; they are drawn at even steps",
            geometry.worstOffGridMm, geometry.stepMm)});
    }
    if (geometry.tiltDeg > kShownTiltDeg) {
        geometry.warnings.push_back(
            {fmt::format("slices step {:.2f} degrees off their normal (gantry tilt); the volume is drawn "
                         "sheared as acquired",
                         geometry.tiltDeg)});
    }
    const auto differs = [&](double stated, double found) {
        return std::abs(stated - found) > allowedMm(found);
    };
    if (first.statedStepMm && differs(*first.statedStepMm, geometry.stepMm) &&
        differs(*first.statedStepMm, alongStepMm)) {
        geometry.warnings.push_back({fmt::format(
            "SpacingBetweenSlices says {:.6g} mm, the positions say {:.6g} mm; the positions are used",
            *first.statedStepMm, geometry.stepMm)});
    }
    if (first.tiltDeg && std::abs(std::abs(*first.tiltDeg) - geometry.tiltDeg) > 0.5) {
        geometry.warnings.push_back({fmt::format(
            "GantryDetectorTilt says {:.4g} degrees, the positions say {:.2f}; the positions are used",
            *first.tiltDeg, geometry.tiltDeg)});
    }
}

glm::dvec3 singleSliceStep(const SlicePlacement& slice, std::vector<Warning>& warnings) {
    const auto usable = [](const std::optional<double>& v) { return v && std::isfinite(*v) && *v > 0.0; };
    double stepMm = 1.0;
    std::string_view source = "an assumption";
    if (usable(slice.statedStepMm)) {
        stepMm = *slice.statedStepMm;
        source = "SpacingBetweenSlices";
    } else if (usable(slice.thicknessMm)) {
        stepMm = *slice.thicknessMm;
        source = "SliceThickness";
    }
    warnings.push_back(
        {fmt::format("a single slice: its extent along the normal is {:.6g} mm by {}", stepMm, source)});
    return normalOf(slice) * stepMm;
}

}  // namespace

Result<SeriesGeometry> placeSlices(std::span<const SlicePlacement> slices) {
    if (slices.empty()) return fail(ErrorCode::InvalidArgument, "a series without slices has no geometry");
    if (auto alike = checkAlike(slices); !alike) return tl::unexpected(alike.error());
    const Line line = ordered(slices);
    SeriesGeometry geometry;
    geometry.order = line.order;
    const SlicePlacement& first = line.at(0);
    glm::dvec3 step{0};
    if (slices.size() == 1) {
        step = singleSliceStep(first, geometry.warnings);
        geometry.stepMm = glm::length(step);
    } else {
        if (auto distinct = checkDistinct(line); !distinct) return tl::unexpected(distinct.error());
        const auto even = evenStep(line, geometry.worstOffGridMm);
        if (!even) return tl::unexpected(even.error());
        step = *even;
        geometry.stepMm = glm::dot(step, line.normal);
        geometry.tiltDeg = tiltDeg(step, line.normal);
        compareStated(line, geometry, glm::length(step));
    }
    geometry.patientFromIndex =
        glm::dmat4(glm::dvec4(glm::normalize(first.rowDirection) * first.spacingMm.x, 0.0),
                   glm::dvec4(glm::normalize(first.columnDirection) * first.spacingMm.y, 0.0),
                   glm::dvec4(step, 0.0), glm::dvec4(first.positionMm, 1.0));
    return geometry;
}

}  // namespace pellucid::io
