// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "renderer/plan/plan.h"
#include "scene/scene.h"

namespace pellucid::renderer {

/// The smallest table whose worst error is below 1/16384 (a sixty-fourth of a grey level a voxel), at most
/// 16384 entries; among those too coarse (at a jump all are), the one with the least error times the width
/// over which it is made. `values` is the physical range the filter can produce, `voxelInUnits` a voxel's
/// length in the function's unit length, times the density scale.
[[nodiscard]] TableLayout layoutTable(const TransferFunction1D& function, ValueRange values,
                                      double voxelInUnits);

/// The function from where it begins to show to where it ends: what lies beyond has no extinction, and its
/// colour does not matter in modes that weigh colours with extinction. A function that jumps there keeps a
/// margin of 1/64, so that the jump lies within the table.
[[nodiscard]] TransferFunction1D visiblePart(const TransferFunction1D& function);

/// The function with control-point colours decoded to light-linear when that is the compositing space.
[[nodiscard]] TransferFunction1D inCompositingSpace(const TransferFunction1D& function,
                                                    CompositingSpace space);

/// Physical values a filter can make of voxels in `range`: Catmull-Rom overshoots (its weights' absolute sum
/// is at most 1.25 an axis, 1.953125 in three), the others do not.
[[nodiscard]] ValueRange reachableValues(ValueRange range, Filter filter);

}  // namespace pellucid::renderer
