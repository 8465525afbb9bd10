// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "renderer/plan/plan.h"
#include "scene/image.h"

namespace pellucid::renderer {

/// How wrong a picture is, in units of what is shown (1 = full range; 1/255 = one grey level).
struct ErrorEstimate {
    double maxError = 0.0;  ///< Largest over the probed pixels, by comparison with a quarter of the step.
    double rmse = 0.0;      ///< Over the probed pixels and RGB.
    double terminationBound = 0.0;  ///< What early ray termination may add at most.
    double tableBound = 0.0;        ///< What the transfer table may add at most for one voxel's colour.
    int probedPixels = 0;
    std::string method;  ///< A sentence: how it was found.
};

struct FrameCost {
    double gpuMs = 0.0;      ///< Sum over all tiles: GPU timer queries; on a software device the wall clock
                             ///< around each finished tile.
    double wallMs = 0.0;     ///< From the call to the pixels, uploads and compilation included.
    double prepareMs = 0.0;  ///< The part of wallMs before the first tile: compile, upload, tables.
    int tiles = 0;
    std::int64_t rays = 0;  ///< Traced; fewer than pixels where the others are interpolated.
    double longestTileMs = 0.0;
};

/// Pixels, what they cost and how wrong they are.
struct Frame {
    ImageF image;
    FrameCost cost;
    std::optional<ErrorEstimate> error;  ///< When asked for.
    Plan plan;
    /// Where a tolerance was asked for that the error estimate does not show to be met: why, a sentence.
    std::string unmet;
    std::optional<Quality> chosen;  ///< Where the scene's quality is automatic: what was found for it.
    bool preview = false;  ///< Drawn with a quickly made table; the same scene drawn again has the exact one.
};

}  // namespace pellucid::renderer
