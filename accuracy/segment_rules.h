// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "accuracy/medium.h"

/// How a segment becomes a colour and a depth (docs/equations.md, 7 to 13), in double and without tables.
namespace pellucid::accuracy {

/// Unassociated colour of a segment as seen through itself, and its optical depth.
struct SegmentOptics {
    glm::dvec3 color{0.0};
    double depth = 0.0;
};

/// From the middle: equations 7 and 8.
[[nodiscard]] SegmentOptics exponentialRule(const LocalOptics& middle, double lengthMm);
[[nodiscard]] SegmentOptics riemannRule(const LocalOptics& middle, double lengthMm);
/// From both ends (9), and the middle (10).
[[nodiscard]] SegmentOptics trapezoidRule(const LocalOptics& front, const LocalOptics& back, double lengthMm);
[[nodiscard]] SegmentOptics simpsonRule(const LocalOptics& front, const LocalOptics& middle,
                                        const LocalOptics& back, double lengthMm);
/// Places of the two-point Gauss-Legendre rule on [0, 1]; and the rule (11).
inline constexpr double kGaussFirst = 0.21132486540518711775;
[[nodiscard]] SegmentOptics gaussLegendreRule(const LocalOptics& first, const LocalOptics& second,
                                              double lengthMm);
/// The value runs linearly from one to the other. Exact (12): the optics' pieces are integrated one by one.
[[nodiscard]] SegmentOptics linearValueRule(const Optics& optics, double front, double back, double lengthMm);
/// The same with the colour's self-attenuation inside the segment neglected (13).
[[nodiscard]] SegmentOptics runningIntegralRule(const Optics& optics, double front, double back,
                                                double lengthMm);

}  // namespace pellucid::accuracy
