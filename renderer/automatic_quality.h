// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/error_estimate.h"

namespace pellucid::renderer {

/// A picture and the time it took to draw, without preparation.
struct TimedImage {
    ImageF image;
    double ms = 0.0;
};
using DrawTimed = std::function<Result<TimedImage>(const Scene& scene)>;

/// The settings that draw `scene` cheapest with an error below its tolerance, found by trying: integrators
/// that suit different scenes (one sample a segment, running integrals) are drawn with steps from long to
/// short at a reduced size, until they are close enough to a picture whose own error is a quarter of the
/// tolerance; steps in between follow from the errors on either side, the cost of a step from the times.
/// What earlier termination may add at most is a tenth of the tolerance. Precondition: quality.automatic, and
/// a mode with steps (not Slice). Errors: those of `draw`.
[[nodiscard]] Result<Quality> chooseQuality(const Scene& scene, const DrawTimed& draw);

/// A picture drawn with `quality` had the estimated error `error` (display units).
struct Attempt {
    Quality quality;
    double error = 0.0;
};
/// The settings of the last attempt, which was not good enough, with the step that should be: between 4/5 of
/// it and a sixteenth. Errors are taken as the power of the step that the last two attempts show, as
/// proportional to it after only one. Where not every pixel had a ray, and the largest error counts or the
/// error stayed when the step was shortened, the settings before that with a ray a pixel. Precondition: at
/// least one attempt.
[[nodiscard]] Quality refined(const std::vector<Attempt>& attempts);

/// Settings that use more of the tolerance than this attempt, which met it, did: a step up to twice as long,
/// and interpolation between rays that may be wrong by up to twice as much. Nothing when too little is left.
[[nodiscard]] std::optional<Quality> coarser(const Attempt& attempt);

/// True when an error so estimated is below the tolerance, the uncertainty of estimates allowed for.
[[nodiscard]] bool meetsTolerance(const Quality& quality, const ErrorEstimate& estimate);

/// Why a picture so estimated does not meet its tolerance, a sentence; empty when it does. `whyNoFiner`: why
/// it was not drawn with finer settings.
[[nodiscard]] std::string whyUnmet(const Quality& quality, const ErrorEstimate& estimate,
                                   const std::string& whyNoFiner);

/// The tolerance in display units (1 = full range).
[[nodiscard]] double toleranceOf(const Quality& quality);
/// An error in the norm that a tolerance is in.
[[nodiscard]] double errorIn(ErrorNorm norm, const PictureError& error);
[[nodiscard]] double errorIn(ErrorNorm norm, const ErrorEstimate& estimate);

}  // namespace pellucid::renderer
