// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "accuracy/medium.h"

/// Emission and absorption (docs/equations.md, 4) over pieces of a ray on which everything is smooth.
namespace pellucid::accuracy {

/// What a ray through the medium has met, in the compositing space.
struct RayIntegral {
    glm::dvec3 color{0.0};      ///< Integral of T kappa c ds.
    double opticalDepth = 0.0;  ///< Integral of kappa ds.
};

/// Three-stage Gauss-Legendre collocation (Hairer, Norsett, Wanner, "Solving Ordinary Differential Equations
/// I", table II.7.4): nodes and weights of the quadrature, and the weights of the integrals from 0 to each
/// node.
inline constexpr double kRoot15 = 3.872983346207417;
inline constexpr std::array<double, 3> kNodes{0.5 - kRoot15 / 10.0, 0.5, 0.5 + kRoot15 / 10.0};
inline constexpr std::array<double, 3> kWeights{5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};
inline constexpr std::array<std::array<double, 3>, 3> kUpToNode{{
    {5.0 / 36.0, 2.0 / 9.0 - kRoot15 / 15.0, 5.0 / 36.0 - kRoot15 / 30.0},
    {5.0 / 36.0 + kRoot15 / 24.0, 2.0 / 9.0, 5.0 / 36.0 - kRoot15 / 24.0},
    {5.0 / 36.0 + kRoot15 / 30.0, 2.0 / 9.0 + kRoot15 / 15.0, 5.0 / 36.0},
}};

inline constexpr double kDeepestPiece =
    0.25;  ///< Optical depth: (1/4)^7 / 7! leaves an order-6 error below 1e-8 a piece.
inline constexpr double kShadeError =
    3e-7;  ///< Of a piece, in display units; pieces with a jump add up to some 1e-6 a ray.
inline constexpr double kNothingSeen =
    50.0;                                ///< Behind this optical depth exp(-50) = 2e-22 of the light passes.
inline constexpr int kMaxHalvings = 60;  ///< Beyond the 53 bits of a double.

/// How far the parabola through the colours at the three nodes misses the colours at the two ends.
[[nodiscard]] inline double bend(const std::array<glm::dvec3, 3>& nodes, const glm::dvec3& from,
                                 const glm::dvec3& to) {
    constexpr double kFar = (5.0 - kRoot15) / 6.0;  // Lagrange's polynomials of the nodes, at 0.
    constexpr double kMiddle = -2.0 / 3.0;
    constexpr double kNear = (5.0 + kRoot15) / 6.0;
    const glm::dvec3 missed =
        glm::max(glm::abs(kNear * nodes[0] + kMiddle * nodes[1] + kFar * nodes[2] - from),
                 glm::abs(kFar * nodes[0] + kMiddle * nodes[1] + kNear * nodes[2] - to));
    return std::max({missed.r, missed.g, missed.b});
}

/// Adds the piece from `from` to `to` behind what `sum` has met. opticsAt(t): LocalOptics; shadeAt(t, color):
/// reflected colour, asked for jumps where `lit`. Halved until the optical depth is at most 1/4 and a jump of
/// the shade is closed in on.
template <class OpticsAt, class ShadeAt>
void addSmoothPiece(double from, double to, const OpticsAt& opticsAt, const ShadeAt& shadeAt, bool lit,
                    RayIntegral& sum, int depth = 0) {
    const double length = to - from;
    std::array<LocalOptics, 3> local{};
    std::array<double, 3> extinction{};
    double total = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        local[i] = opticsAt(from + kNodes[i] * length);
        extinction[i] = local[i].extinction;
        total += kWeights[i] * extinction[i] * length;
    }
    if (total <= 0.0 || sum.opticalDepth > kNothingSeen) {
        sum.opticalDepth += total;
        return;
    }
    const auto halve = [&] {
        const double middle = from + length / 2.0;
        addSmoothPiece(from, middle, opticsAt, shadeAt, lit, sum, depth + 1);
        addSmoothPiece(middle, to, opticsAt, shadeAt, lit, sum, depth + 1);
    };
    if (total > kDeepestPiece && depth < kMaxHalvings) return halve();

    std::array<glm::dvec3, 3> colors{};
    glm::dvec3 weighted(0.0);
    double weights = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        double depthToNode = 0.0;
        for (std::size_t j = 0; j < 3; ++j) depthToNode += kUpToNode[i][j] * extinction[j] * length;
        const double weight = kWeights[i] * extinction[i] * std::exp(-depthToNode);
        colors[i] = shadeAt(from + kNodes[i] * length, local[i].color);
        weighted += weight * colors[i];
        weights += weight;
    }
    // A normal that turns to the viewer makes the shade jump; it is closed in on, or the order would drop
    // to 1.
    if (lit && depth < kMaxHalvings) {
        const auto shadeOf = [&](double t) { return shadeAt(t, opticsAt(t).color); };
        const double shown = total * std::exp(-sum.opticalDepth);
        if (bend(colors, shadeOf(from), shadeOf(to)) * shown > kShadeError) return halve();
    }

    // The mean colour times the exact opacity: a constant colour then comes out exactly, whatever the
    // extinction.
    sum.color += weighted / weights * -std::expm1(-total) * std::exp(-sum.opticalDepth);
    sum.opticalDepth += total;
}

}  // namespace pellucid::accuracy
