// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "accuracy/field.h"
#include "accuracy/ray_clip.h"

namespace pellucid::accuracy {

/// A ray in index space; its parameter t is in patient mm from the ray's start.
struct IndexRay {
    glm::dvec3 origin{0.0};
    glm::dvec3 perMm{0.0};  ///< Index units per mm.

    [[nodiscard]] glm::dvec3 at(double t) const { return origin + t * perMm; }
};

/// A part of a ray inside one cell.
struct Segment {
    glm::ivec3 cell{0};
    double from = 0.0;
    double to = 0.0;
};

/// Where the ray is inside the box [inset - 0.5, size - 0.5 - inset], not before `start`; nothing when the
/// two do not overlap.
[[nodiscard]] inline std::optional<Interval> insideBox(const IndexRay& ray, glm::ivec3 size, double start,
                                                       double inset) {
    Interval inside{start, std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = inset - 0.5 - ray.origin[axis];
        const double hi = size[axis] - 0.5 - inset - ray.origin[axis];
        if (ray.perMm[axis] == 0.0) {
            if (lo > 0.0 || hi < 0.0) return std::nullopt;
            continue;
        }
        const double a = lo / ray.perMm[axis];
        const double b = hi / ray.perMm[axis];
        inside.from = std::max(inside.from, std::min(a, b));
        inside.to = std::min(inside.to, std::max(a, b));
    }
    if (!(inside.from < inside.to)) return std::nullopt;
    return inside;
}

/// Calls visit(Segment) in ray order, cell by cell, with segments of at most stepMm, until it returns false;
/// returns what it returned last.
template <class Visit>
bool walkCells(const Field& field, const IndexRay& ray, const Interval& range, double stepMm, Visit&& visit) {
    double from = range.from;
    while (from < range.to) {
        // The cell just ahead: a point on a border belongs to the side the ray goes to.
        double to = range.to;
        const glm::dvec3 here = ray.at(from) + field.cellOffset();
        for (int axis = 0; axis < 3; ++axis) {
            const double speed = ray.perMm[axis];
            if (speed == 0.0) continue;
            double border = speed > 0.0 ? std::floor(here[axis]) + 1.0 : std::ceil(here[axis]) - 1.0;
            double t = (border - field.cellOffset() - ray.origin[axis]) / speed;
            if (!(t > from))
                t = (border + std::copysign(1.0, speed) - field.cellOffset() - ray.origin[axis]) / speed;
            to = std::min(to, t);
        }
        if (!(to > from)) return true;  // The rest is shorter than double can tell.
        const glm::ivec3 cell = field.cellOf(ray.at((from + to) / 2.0));
        const auto parts =
            std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil((to - from) / stepMm)));
        const double length = to - from;
        double partFrom = from;
        for (std::int64_t part = 1; part <= parts; ++part) {
            const double partTo =
                part == parts ? to : from + length * static_cast<double>(part) / static_cast<double>(parts);
            if (partTo > partFrom && !visit(Segment{cell, partFrom, partTo})) return false;
            partFrom = partTo;
        }
        from = to;
    }
    return true;
}

}  // namespace pellucid::accuracy
