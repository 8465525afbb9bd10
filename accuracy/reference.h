// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "accuracy/ray_clip.h"
#include "scene/image.h"
#include "scene/progress.h"
#include "scene/scene.h"

namespace pellucid::accuracy {

/// A reference picture and how converged it is.
struct Reference {
    ImageF image;               ///< Same conventions as the renderer's.
    double reachedBound = 0.0;  ///< Largest difference of the last two pictures, in display units.
    double reachedRmse = 0.0;   ///< Root mean square of that difference, over RGB.
    double stepMm = 0.0;        ///< Of the last picture.
};

struct ReferenceOptions {
    double bound =
        1e-5;  ///< Asked for: halve the step until two successive pictures differ by less, anywhere.
    int maxHalvings = 8;
    Progress progress;
    double insetVoxels = 0.0;  ///< The volume ends this far inside the box that its voxels fill, in [0, 0.5].
    RayClip clip{};            ///< What is visible of a ray; empty: all that is inside the volume.
};

/// The same optical model as the renderer, integrated on the CPU in double precision by independent code (no
/// shared sampling, table or shader): transfer function evaluated exactly, no early termination, all cores.
/// Starts from the scene's own step. Modes: all. Errors: as makePlan, Cancelled.
[[nodiscard]] Result<Reference> referencePicture(const Scene& scene, const std::vector<VolumePtr>& volumes,
                                                 const ReferenceOptions& options = {});

/// One picture at a fixed step, for convergence studies.
[[nodiscard]] Result<ImageF> referenceAtStep(const Scene& scene, const std::vector<VolumePtr>& volumes,
                                             double stepMm, const Progress& progress = {});

}  // namespace pellucid::accuracy
