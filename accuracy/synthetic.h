// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "scene/volume.h"

namespace pellucid::accuracy {

/// Volumes with known content, for closed forms and benchmarks. All have one component; values that an
/// integer type cannot hold are rounded to nearest and clamped.

/// value(index) at every voxel centre. Precondition: the grid is valid.
[[nodiscard]] VolumePtr sampledVolume(const Grid& grid, VoxelType type,
                                      const std::function<double(glm::ivec3)>& value,
                                      ValueMapping mapping = {});

/// The test signal of Marschner and Lobb, "An evaluation of reconstruction filters for volume rendering",
/// Visualization 1994, on [-1, 1]^3 with f_M = 6 and alpha = 0.25; values in [0, 1] stored in 16 bits, n
/// voxels of 2 / (n - 1) mm x 50.
[[nodiscard]] VolumePtr marschnerLobb(int n);

/// Nested ellipsoids with HU of air, skin, fat, muscle, bone and marrow, soft edges and a little texture;
/// int16.
[[nodiscard]] VolumePtr ctLikeShells(int n);
/// The same in a field of view of 384 mm x 384 mm x 1.25 mm a slice, as of a scanner.
[[nodiscard]] VolumePtr ctLikeShells(glm::ivec3 size);

/// Independent uniform values in [0, 1], float. The same seed gives the same volume on every machine.
[[nodiscard]] VolumePtr randomVolume(const Grid& grid, std::uint64_t seed);

}  // namespace pellucid::accuracy
