// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/plan/skipping.h"
#include "scene/progress.h"
#include "scene/volume.h"

namespace pellucid::renderer {

/// Smallest and largest value of each block of kBlockEdge^3 voxels and of those that reconstruction reads
/// there (Engel et al. 2006, section 7.3.4). Values are those of the volume texture, u in [0, 1], in 65535
/// quanta, rounded outwards: exact for 16-bit textures.
struct BlockRanges {
    glm::ivec3 blocks{0};
    std::vector<std::uint16_t> lo;  ///< i fastest.
    std::vector<std::uint16_t> hi;
};

/// `padding`: voxels beyond the block's own that count as its, on every side. A filter that reads n voxels to
/// each side of a point needs n, and then knows a margin of half a voxel: a point that lies up to half a
/// voxel outside the block still reads nothing else. On all cores; values that are not finite count as the
/// texture has them. Cancelled: no blocks.
[[nodiscard]] BlockRanges blockRanges(const Volume& volume, int component, int padding,
                                      const Progress& progress = {});

}  // namespace pellucid::renderer
