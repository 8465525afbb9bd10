// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/segment_rules.h"

#include <algorithm>
#include <cmath>

#include "accuracy/smooth_piece.h"

namespace pellucid::accuracy {
namespace {

/// Calls visit(piece, from, to), parts of the segment [0, 1] on which the function is one line.
template <class Visit>
void splitAtPoints(const Optics& optics, double front, double back, double from, double to,
                   const Visit& visit) {
    const auto valueAt = [&](double s) { return front + s * (back - front); };
    const int point = optics.pointBetween(valueAt(from), valueAt(to));
    const double at = point < 0 ? to : (optics.pointValue(point) - front) / (back - front);
    if (point >= 0 && at > from && at < to) {
        splitAtPoints(optics, front, back, from, at, visit);
        splitAtPoints(optics, front, back, at, to, visit);
        return;
    }
    visit(optics.pieceOf(valueAt(0.5 * (from + to))), from, to);
}

glm::dvec3 meanOf(const glm::dvec3& weighted, double weights, const glm::dvec3& otherwise) {
    return weights > 0.0 ? weighted / weights : otherwise;
}

}  // namespace

SegmentOptics exponentialRule(const LocalOptics& middle, double lengthMm) {
    return {middle.color, middle.extinction * lengthMm};
}

SegmentOptics riemannRule(const LocalOptics& middle, double lengthMm) {
    const double depth = middle.extinction * lengthMm;
    return {depth > 0.0 ? middle.color * (depth / -std::expm1(-depth)) : middle.color, depth};
}

SegmentOptics trapezoidRule(const LocalOptics& front, const LocalOptics& back, double lengthMm) {
    const double sum = front.extinction + back.extinction;
    return {meanOf(front.extinction * front.color + back.extinction * back.color, sum,
                   0.5 * (front.color + back.color)),
            0.5 * sum * lengthMm};
}

SegmentOptics simpsonRule(const LocalOptics& front, const LocalOptics& middle, const LocalOptics& back,
                          double lengthMm) {
    const double a = front.extinction, m = middle.extinction, b = back.extinction;
    const double depth = lengthMm / 6.0 * (a + 4.0 * m + b);
    const double toMiddle = std::clamp(lengthMm / 24.0 * (5.0 * a + 8.0 * m - b), 0.0, depth);
    const double atMiddle = 4.0 * m * std::exp(-toMiddle);
    const double atBack = b * std::exp(-depth);
    return {meanOf(a * front.color + atMiddle * middle.color + atBack * back.color, a + atMiddle + atBack,
                   middle.color),
            depth};
}

SegmentOptics gaussLegendreRule(const LocalOptics& first, const LocalOptics& second, double lengthMm) {
    // Two-stage Gauss method (Hairer, Norsett, Wanner, table II.7.3): the integrals up to both nodes.
    const double off = 0.5 - kGaussFirst;  // sqrt(3) / 6
    const double a = first.extinction, b = second.extinction;
    const double depth = 0.5 * lengthMm * (a + b);
    const double toFirst = std::clamp(lengthMm * (0.25 * a + (0.25 - off) * b), 0.0, depth);
    const double toSecond = std::min(lengthMm * ((0.25 + off) * a + 0.25 * b), depth);
    const double atFirst = a * std::exp(-toFirst);
    const double atSecond = b * std::exp(-toSecond);
    return {meanOf(atFirst * first.color + atSecond * second.color, atFirst + atSecond,
                   0.5 * (first.color + second.color)),
            depth};
}

SegmentOptics linearValueRule(const Optics& optics, double front, double back, double lengthMm) {
    RayIntegral sum;
    splitAtPoints(optics, front, back, 0.0, 1.0, [&](int piece, double from, double to) {
        addSmoothPiece(
            from * lengthMm, to * lengthMm,
            [&](double t) { return optics.at(piece, front + t / lengthMm * (back - front)); },
            [](double, const glm::dvec3& color) { return color; }, false, sum);
    });
    // What is too thin for an opacity in double has the colour of (13).
    const double opacity = -std::expm1(-sum.opticalDepth);
    if (!(opacity > 1e-12)) return runningIntegralRule(optics, front, back, lengthMm);
    return {sum.color / opacity, sum.opticalDepth};
}

SegmentOptics runningIntegralRule(const Optics& optics, double front, double back, double lengthMm) {
    glm::dvec3 emission(0.0);
    double extinction = 0.0;
    splitAtPoints(optics, front, back, 0.0, 1.0, [&](int piece, double from, double to) {
        // Emission is a parabola on a piece, on which three nodes are exact.
        for (std::size_t i = 0; i < 3; ++i) {
            const double at = from + kNodes[i] * (to - from);
            const LocalOptics local = optics.at(piece, front + at * (back - front));
            const double weight = kWeights[i] * (to - from) * local.extinction;
            emission += weight * local.color;
            extinction += weight;
        }
    });
    return {meanOf(emission, extinction, optics.at(front).color), extinction * lengthMm};
}

}  // namespace pellucid::accuracy
