// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/plan/plan.h"

namespace pellucid::renderer {

/// The most light a point can send relative to its colour, at least 1: what is hidden behind transmittance T
/// changes the picture by at most T times this.
[[nodiscard]] double brightestReflection(const Scene& scene);

/// What the numbers of a scene make of each other, and of the volume's size, must stay within what floats
/// hold; single ones are limited by validate(). Precondition: the plan's steps are known. Errors:
/// InvalidArgument.
[[nodiscard]] Result<void> checkNumbers(const Scene& scene, const Plan& plan, const Grid& grid);

}  // namespace pellucid::renderer
