// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "scene/result.h"

namespace pellucid {

/// The extinction that opacity 1 is stored as: 24 ln 2, so that 1 - exp(-tau) = 1 - 2^-24, the largest float
/// below 1. Extinctions above it are legal (dense media); they merely all show as opacity 1.
inline constexpr double kOpaqueExtinction = 16.635532333438686;

/// The largest extinction allowed: pictures are computed in floats.
inline constexpr double kLargestExtinction = 1e30;

/// tau = -ln(1 - alpha) per unit length, capped at kOpaqueExtinction (Engel et al. 2006, eq. 1.17 in
/// extinction form). Precondition: alpha in [0, 1].
[[nodiscard]] double extinctionFromOpacity(double alpha);
/// alpha = 1 - exp(-tau), exact for small tau; 1 from kOpaqueExtinction on. Precondition: tau >= 0.
[[nodiscard]] double opacityFromExtinction(double tau);

/// A control point. Between two points colour and extinction are linear in the value; two points at one value
/// are a step (the later one holds from there on). Below the first and above the last point they stay
/// constant.
struct TransferPoint {
    double value = 0.0;               ///< Physical value.
    glm::dvec3 color{1.0, 1.0, 1.0};  ///< Unassociated display-encoded RGB in [0, 1].
    double extinction = 0.0;          ///< tau per unit length, in [0, kLargestExtinction].
    bool operator==(const TransferPoint&) const = default;
};

/// Piecewise linear, at least one point, values not descending.
struct TransferFunction1D {
    std::string name;
    std::string unit;  ///< Of the values: "HU", "" when unitless.
    std::vector<TransferPoint> points;
    bool operator==(const TransferFunction1D&) const = default;
};

struct OpticalSample {
    glm::dvec3 color{0.0};
    double extinction = 0.0;  ///< Per unit length.
};

/// Errors: InvalidArgument, the message beginning with the JSON pointer below the function ("/points/3/value:
/// ..."): no points, more than 65536, descending or non-finite values, colour outside [0, 1], extinction
/// outside [0, kLargestExtinction].
[[nodiscard]] Result<void> validate(const TransferFunction1D& function);

/// Evaluates at a physical value; NaN gives the first point. Precondition: validate() passed. O(log n).
[[nodiscard]] OpticalSample evaluate(const TransferFunction1D& function, double value);

/// A table of n >= 2 entries (RGB, extinction per unit length) at lo, ..., hi, both ends included, to be read
/// with linear interpolation.
[[nodiscard]] std::vector<glm::vec4> bakeTable(const TransferFunction1D& function, double lo, double hi,
                                               int n);

/// A start for any modality: grey rises from black at `lo` to white at `hi`, extinction from 0 to that of
/// `opacityAtHi`; both stay constant outside. With lo == hi it is a step. Preconditions: lo <= hi,
/// opacityAtHi in [0, 1].
[[nodiscard]] TransferFunction1D rampFunction(double lo, double hi, double opacityAtHi);

/// The function with points added between the given ones, so that its curve, linear in extinction, follows
/// the one that is linear in opacity between the given points within `bound` of opacity everywhere. For
/// functions that come from programs where opacity is what is linear. Preconditions: validate() passed, bound
/// > 0.
[[nodiscard]] TransferFunction1D followingOpacity(const TransferFunction1D& function,
                                                  double bound = 0.5 / 255.0);

}  // namespace pellucid
