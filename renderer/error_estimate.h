// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "renderer/frame.h"

namespace pellucid::renderer {

/// The step of the picture compared with, in steps of the picture estimated.
inline constexpr double kComparisonStep = 0.25;

/// Draws the scene as it is given, without further estimates.
using DrawScene = std::function<Result<ImageF>(const Scene& scene)>;

/// Largest and root mean square difference over pixels and RGB, display units. Precondition: equal sizes.
struct PictureError {
    double max = 0.0;
    double rmse = 0.0;
};
[[nodiscard]] PictureError pictureError(const ImageF& a, const ImageF& b);

/// Running integrals in place of pre-integration, whose tables belong to one step and take longer to make
/// than a picture that is only compared with; the limit is the same. Importance steps follow from the data,
/// not from the scene's step: beside themselves they would show no error.
[[nodiscard]] Integrator withoutTable(Integrator integrator);

/// The scene with a quarter of the step and nothing else that is known to be inexact; `plan` is the scene's.
/// Composite and X-ray pictures are compared with running integrals, which miss no peak of the function
/// between two samples; but those of rules of order 4 with themselves, where no control point lies within the
/// values that occur and they are better.
[[nodiscard]] Scene comparison(const Scene& scene, const Plan& plan);
/// The same by the scene's own rule. Takes fewer turns of a driver's loop where that rule does, so it may be
/// drawn where the plan refuses comparison().
[[nodiscard]] Scene comparisonWithItself(const Scene& scene, const Plan& plan);
/// A difference of pictures of `plan`'s scene as its error, with the bounds that the plan knows.
[[nodiscard]] ErrorEstimate errorOf(PictureError difference, const ImageF& picture, const Plan& plan,
                                    std::string method);
/// The error of the picture of `plan`'s scene, of which `better` is the comparison's.
[[nodiscard]] ErrorEstimate errorBeside(const ImageF& better, const ImageF& picture, const Plan& plan);

/// The error of a picture by comparison with a better one (docs/equations.md, 19): the scene is drawn again
/// with a quarter of the step (comparison()) and without what else may be wrong (early termination, low
/// accumulation formats, the adaptive rule's tolerance), and the difference times 1.15 is the estimate. For a
/// rule of order 1, 2 or 4 the error is 1.33, 1.07 or 1.00 differences, for independent errors (jumps) about
/// 0.97. `picture` is compared as it is; without it the scene is drawn with both steps at a size divided by
/// `reduction`. Modes without a step (slice) have no such error.
[[nodiscard]] Result<ErrorEstimate> estimateError(const Scene& scene, const Plan& plan, const ImageF* picture,
                                                  int reduction, const DrawScene& draw);

}  // namespace pellucid::renderer
