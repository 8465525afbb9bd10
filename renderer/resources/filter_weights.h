// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gpu/gl_handle.h"

namespace pellucid::renderer {

inline constexpr int kFilterWeightTexels = 128;

/// The four weights of the cubic B-spline at u = n / 127, RGBA32F: interpolated linearly, a value of one axis
/// is off by at most 4 max|w''| h^2 / 8 = 6.2e-5 of the range of the four voxels (h = 1 / 127, max|w''| = 2).
[[nodiscard]] GlTexture createBSplineWeights();

}  // namespace pellucid::renderer
