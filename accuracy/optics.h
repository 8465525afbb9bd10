// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.h"

namespace pellucid::accuracy {

/// Colour (unassociated, compositing space) and extinction per mm at a point (docs/equations.md, 2).
struct LocalOptics {
    glm::dvec3 color{0.0};
    double extinction = 0.0;
};

/// A transfer function in the compositing space, taken apart into its linear pieces, so that an integral can
/// be split where the function bends or jumps. Colours of control points are decoded first and interpolated
/// then.
class Optics {
public:
    /// Precondition: validate(function) passed, unitLengthMm > 0.
    Optics(const TransferFunction1D& function, CompositingSpace space, double unitLengthMm,
           double densityScale);

    /// Piece p holds the values between point p - 1 and point p; 0 is below the first point, count of points
    /// is above the last.
    [[nodiscard]] int pieceOf(double value) const;
    /// The index of the middle one of the points whose value lies strictly between two values; -1 when none
    /// does.
    [[nodiscard]] int pointBetween(double a, double b) const;
    [[nodiscard]] double pointValue(int point) const {
        return m_points[static_cast<std::size_t>(point)].value;
    }

    /// Unassociated colour in the compositing space.
    [[nodiscard]] glm::dvec3 color(int piece, double value) const;
    [[nodiscard]] double extinctionPerMm(int piece, double value) const;
    [[nodiscard]] LocalOptics at(int piece, double value) const {
        return {color(piece, value), extinctionPerMm(piece, value)};
    }
    [[nodiscard]] LocalOptics at(double value) const { return at(pieceOf(value), value); }

private:
    /// The piece's line: value = weight of the upper one of two points.
    struct Place {
        std::size_t lower;
        std::size_t upper;
        double weight;
    };
    [[nodiscard]] Place placeOf(int piece, double value) const;

    std::vector<TransferPoint> m_points;  ///< Extinction per mm here.
};

}  // namespace pellucid::accuracy
