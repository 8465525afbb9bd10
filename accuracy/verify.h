// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "renderer/renderer.h"
#include "scene/progress.h"

namespace pellucid::accuracy {

/// What a row of the convergence test holds an observation against.
enum class Claim {
    Order,       ///< The observed order equals the expected one within the tolerance.
    AtLeast,     ///< The same, or a higher order: errors of neighbouring cells may cancel.
    Independent  ///< The error does not depend on what is refined, and stays below the tolerance.
};

/// One line of the convergence test: pictures of a sequence of refinements and how their error falls.
struct OrderRow {
    std::string refinement;  ///< "step", "grid", "pixel", or "tolerance" (adaptive steps).
    std::string mode;
    std::string integrator;  ///< Empty where the mode has none.
    std::string filter;
    Claim claim = Claim::Order;
    double expected = 0.0;   ///< Order; 0 for Independent.
    double tolerance = 0.0;  ///< Of the order; Independent: the largest figure of `errors` allowed.
    std::string reason{};    ///< Why this order and no higher.
    std::vector<double>
        sizes{};  ///< What was refined: step in voxels, voxel or pixel in mm, tolerance in grey levels.
    std::vector<double> errors{};  ///< Mean absolute error over pixels and RGB; Independent: the largest, in
                                   ///< display units or (tolerance) in units of the tolerance.
    std::string rays{"oblique"};   ///< "oblique" and parallel, "perspective", "along an axis".

    /// Slope of log error over log size; Independent: the largest error.
    [[nodiscard]] double observed() const;
    [[nodiscard]] bool passed() const;
};

/// The order of convergence: slope of the least-squares line through log error over log size. NaN when an
/// error is not a positive finite number. Precondition: as many errors as sizes, at least two.
[[nodiscard]] double observedOrder(std::span<const double> sizes, std::span<const double> errors);

/// Given each row once it is there.
using OrderFound = std::function<void(const OrderRow&)>;

/// The convergence test of this renderer on this machine, after Etiene et al., "Verifying volume rendering
/// using discretization error analysis", IEEE TVCG 20(1), 2014: every mode, integrator and filter under
/// refinement of step, voxel grid and pixel. docs/verification.md derives the expected orders. `progress`
/// sees the whole range in each of the three parts (accuracy/verification.h runs them together). Errors:
/// Gpu, Cancelled.
[[nodiscard]] Result<std::vector<OrderRow>> verifyStepOrders(renderer::Renderer& renderer,
                                                             const Progress& progress = {},
                                                             const OrderFound& found = {});
[[nodiscard]] Result<std::vector<OrderRow>> verifyGridOrders(renderer::Renderer& renderer,
                                                             const Progress& progress = {},
                                                             const OrderFound& found = {});
[[nodiscard]] Result<std::vector<OrderRow>> verifyPixelOrders(renderer::Renderer& renderer,
                                                              const Progress& progress = {},
                                                              const OrderFound& found = {});

[[nodiscard]] bool allPassed(std::span<const OrderRow> rows);

/// What a row is held to, "2 +- 0.15", and what was found, "1.98".
[[nodiscard]] std::string expectedText(const OrderRow& row);
[[nodiscard]] std::string observedText(const OrderRow& row);

/// A table for people, one line a row, with the reasons below it; and the same with all figures.
[[nodiscard]] std::string orderText(std::span<const OrderRow> rows);
[[nodiscard]] nlohmann::ordered_json orderJson(std::span<const OrderRow> rows);

}  // namespace pellucid::accuracy
