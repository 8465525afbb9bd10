// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace pellucid::renderer {

/// Voxels along each edge of the blocks that something is known of: their value range, how much they bend.
inline constexpr int kBlockEdge = 4;

/// Number of blocks along each axis; the last ones may be cut.
[[nodiscard]] inline glm::ivec3 blockCount(glm::ivec3 voxels) {
    return (voxels + (kBlockEdge - 1)) / kBlockEdge;
}

/// Number of cells of a grid of this size.
[[nodiscard]] inline std::uint64_t cellCount(glm::ivec3 size) {
    return static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y) *
           static_cast<std::uint64_t>(size.z);
}

}  // namespace pellucid::renderer
