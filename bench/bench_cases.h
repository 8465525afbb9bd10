// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene/result.h"
#include "scene/scene.h"

namespace pellucid::bench {

/// One row of the table: a completed scene and what to call it.
struct BenchCase {
    std::string data;
    std::string look;        ///< "composite", "composite, lit", "mip".
    std::string projection;  ///< "orthographic", "perspective".
    Scene scene;
    VolumePtr volume;
};

/// Marschner-Lobb 128 and shells like a CT of 256, and the volume at `path` when there is one; each as
/// composite, lit composite and MIP, in both projections, 512 x 512, two samples a voxel.
[[nodiscard]] Result<std::vector<BenchCase>> benchCases(const std::string& path);

}  // namespace pellucid::bench
