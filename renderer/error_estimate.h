// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "renderer/frame.h"

namespace pellucid::renderer {

/// Draws the scene as it is given, without further estimates.
using DrawScene = std::function<Result<ImageF>(const Scene& scene)>;

/// The error of a picture by halving the step (Richardson): the scene is drawn at a quarter of its size in
/// each direction with its own step and with half of it. The midpoint rule is of second order where the field
/// is smooth and of first order where the transfer function jumps; for order p the error of the coarser
/// picture is 2^p / (2^p - 1) times the difference. p = 1 is assumed, the larger estimate. The bounds of
/// early termination and of the table stand beside it. Costs 3/16 of the picture's own samples. Modes without
/// a step (slice) have no such error.
[[nodiscard]] Result<ErrorEstimate> estimateError(const Scene& scene, const Plan& plan,
                                                  const DrawScene& draw);

}  // namespace pellucid::renderer
