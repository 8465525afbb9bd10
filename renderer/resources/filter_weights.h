// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gpu/gl_handle.h"
#include "renderer/plan/plan.h"

namespace pellucid::renderer {

/// The four weights of the cubic B-spline at u = n / 127, RGBA32F. Interpolated linearly, a value of one axis
/// is off by at most h^2 / 8 times the positive part of the sum of w_i'' (1, -2, 1, 0 at u = 0, so 2 at most)
/// times the range of the four voxels: 1.6e-5 of it.
[[nodiscard]] GlTexture createBSplineWeights();

}  // namespace pellucid::renderer
