// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace pellucid::accuracy {

/// A part of a ray; mm from its origin.
struct Interval {
    double from = 0.0;
    double to = 0.0;
};

/// What remains of a part of a ray, in ascending order and apart from each other: none, one or several
/// intervals. The ray starts at `originMm` (patient frame) and goes along the unit vector `direction`. What
/// is cut away neither absorbs nor shines, and a surface behind a cut begins on it.
using RayClip = std::function<std::vector<Interval>(const glm::dvec3& originMm, const glm::dvec3& direction,
                                                    const Interval& inside)>;

}  // namespace pellucid::accuracy
