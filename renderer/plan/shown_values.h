// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/plan/plan.h"
#include "scene/scene.h"

namespace pellucid::renderer {

/// What reconstruction reads around a point, and what it makes of it.
struct FilterReach {
    int voxels = 1;          ///< To each side of a point, along each axis.
    double overshoot = 0.0;  ///< Beyond the range of those voxels on both sides, as a part of its extent.
    bool operator==(const FilterReach&) const = default;
};
[[nodiscard]] FilterReach reachOf(Filter filter);

/// Physical values that can change a picture of the scene, as closed intervals, ascending and apart; ends may
/// be infinite. A sample of any other value leaves every picture as it is, and so does a segment both of
/// whose ends, and all between them, have other values. Wide enough for everything the tables make of the
/// function: they interpolate, so what stands in an entry reaches to the neighbouring ones. Preconditions:
/// `plan` is the scene's, and its mode is one in which values can be passed over (planSkipping).
[[nodiscard]] std::vector<ValueRange> shownValues(const Scene& scene, const Plan& plan,
                                                  const VolumeFacts& facts);

}  // namespace pellucid::renderer
