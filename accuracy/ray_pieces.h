// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "accuracy/medium.h"
#include "accuracy/root.h"

/// The parts of a ray on which its medium is smooth. Every walk calls visit in ray order until it returns
/// false, and returns what it returned last.
namespace pellucid::accuracy {

/// A piece of a ray on which value and optics are smooth.
struct Piece {
    glm::ivec3 cell{0};
    int optics = 0;  ///< The transfer function's piece (Optics).
    double from = 0.0;
    double to = 0.0;
};

/// Splits a segment where the value crosses a control point.
template <class Visit>
bool splitAtPoints(const Medium& medium, const ViewRay& ray, const Segment& segment, double valueFrom,
                   double valueTo, const Visit& visit) {
    const auto valueAt = [&](double t) { return medium.valueAt(ray, segment.cell, t); };
    const int point = medium.optics().pointBetween(valueFrom, valueTo);
    if (point >= 0) {
        const double level = medium.optics().pointValue(point);
        const double t = rootBetween(segment.from, segment.to, [&](double s) { return valueAt(s) - level; });
        return splitAtPoints(medium, ray, {segment.cell, segment.from, t}, valueFrom, level, visit) &&
               splitAtPoints(medium, ray, {segment.cell, t, segment.to}, level, valueTo, visit);
    }
    if (!(segment.from < segment.to)) return true;
    const double middle = valueAt((segment.from + segment.to) / 2.0);
    return visit(Piece{segment.cell, medium.optics().pieceOf(middle), segment.from, segment.to});
}

/// At cell borders, at the step and at control points.
template <class Visit>
bool walkPieces(const Medium& medium, const ViewRay& ray, const Interval& range, double stepMm,
                const Visit& visit) {
    return walkCells(medium.field(), ray.index, range, stepMm, [&](const Segment& segment) {
        // Interpolated colours are smooth within a cell.
        if (medium.preClassified()) return visit(Piece{segment.cell, 0, segment.from, segment.to});
        return splitAtPoints(medium, ray, segment, medium.valueAt(ray, segment.cell, segment.from),
                             medium.valueAt(ray, segment.cell, segment.to), visit);
    });
}

/// Pieces of all that is visible of a ray.
template <class Visit>
bool walkVisiblePieces(const Medium& medium, const ViewRay& ray, double stepMm, const Visit& visit) {
    for (const Interval& part : ray.visible)
        if (!walkPieces(medium, ray, part, stepMm, visit)) return false;
    return true;
}

/// Segments within cells of all that is visible of a ray.
template <class Visit>
bool walkVisibleCells(const Medium& medium, const ViewRay& ray, double stepMm, const Visit& visit) {
    for (const Interval& part : ray.visible)
        if (!walkCells(medium.field(), ray.index, part, stepMm, visit)) return false;
    return true;
}

}  // namespace pellucid::accuracy
