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

/// The Marschner-Lobb signal, thin shells in it, fog without empty space, shells like a CT (mostly empty with
/// its bone function) and that as MIP, and each scan with its default look; unlit and lit, both projections,
/// `size` x `size` pixels.
[[nodiscard]] Result<std::vector<BenchCase>> errorCases(const std::vector<std::string>& scans, int size);

/// A smooth 16-bit field of n^3 voxels whose every value shows with fogFunction().
[[nodiscard]] VolumePtr fog(int n);
[[nodiscard]] TransferFunction1D fogFunction();
/// Three peaks of a 25th of the range's width each, at 0.3, 0.5 and 0.7.
[[nodiscard]] TransferFunction1D thinShells();
/// HU; nothing below 150.
[[nodiscard]] TransferFunction1D boneFunction();
/// The camera of all benchmarks: the volume's sphere fills the picture.
void setView(Scene& scene, const Grid& grid, Projection projection);

}  // namespace pellucid::bench
