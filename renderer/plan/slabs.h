// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/plan/plan.h"

namespace pellucid::renderer {

/// Turns of all loops of the program that one sample takes at most, as counted on llvmpipe (Mesa 22.3); what
/// DeviceLimits::maxLoopTurns limits. Of the adaptive integrator: one tried segment.
[[nodiscard]] double turnsPerSample(const Plan& plan);

/// Samples of the longest part of a ray that is drawn at once.
[[nodiscard]] double samplesPerSlab(const Plan& plan);

/// Sees to it that no ray takes more turns than the driver gives: decides whether rays are drawn whole or in
/// slabs, and gives up leaps where they leave too few turns. To be called again whenever other stages are
/// chosen. Errors: InvalidArgument, the step is too short for this driver.
[[nodiscard]] Result<void> fitLoops(Plan& plan, const DeviceLimits& limits);

}  // namespace pellucid::renderer
