// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "accuracy/report_data.h"
#include "scene/image.h"
#include "scene/progress.h"

/// Other renderers on the same scene. VTK is only known behind this header.
namespace pellucid::accuracy {

struct PeerFrames {
    ImageF image;
    double firstMs = 0.0;
    std::vector<double> warmMs;
};

/// Nothing when the peers can draw this scene here, else a sentence why not: no display, built without VTK's
/// volume rendering, or something in the scene that they do not have.
[[nodiscard]] std::optional<std::string> whyNoPeers(const Scene& scene, const Volume& volume);

/// Draws one first and some warm frames by the setting's renderer, on a thread of its own with its own
/// context: same camera, voxels, transfer function, light and sample distance. What cannot be set: VTK's GPU
/// mapper has an 8-bit frame buffer, ends rays at opacity 1 - 1/255 and has its headlight at the eye; the
/// fixed-point mapper works in 15 bits and lights at the voxels; and for both the volume ends at the outer
/// voxel centres (ReferenceKind). Precondition: the scene is completed and
/// drawn at `setting`, and whyNoPeers() is empty.
[[nodiscard]] Result<PeerFrames> drawByPeer(const Scene& scene, const Volume& volume,
                                            const ReportSetting& setting, int warmFrames);

}  // namespace pellucid::accuracy
