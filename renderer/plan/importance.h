// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/plan/blocks.h"
#include "scene/progress.h"
#include "scene/result.h"
#include "scene/scene.h"

namespace pellucid::renderer {

/// How much the data bend in and around each block of voxels (blocks.h), from the data alone: what a transfer
/// function makes of it is the business of pre-integration. For a ray's segment of length d that starts in
/// the block and is no longer than longestImportanceStepMm(), the reconstructed value deviates from the line
/// between its end values by at most (curvature (d / layer)^2 + kinkWeight kinks) / 8 of the data's range,
/// layer being layerMm(grid) (docs/equations.md, 22).
struct ImportanceGrid {
    glm::ivec3 size{0};            ///< Blocks.
    std::vector<glm::vec2> bends;  ///< Curvature and kinks, i fastest.
};

/// Errors: Cancelled.
[[nodiscard]] Result<ImportanceGrid> importanceOf(const Volume& volume, int component,
                                                  const Progress& progress = {});

/// Bytes of the texture.
[[nodiscard]] std::uint64_t importanceBytes(const Grid& grid);

/// Thickness of the thinnest layer of voxels: the smallest spacing where the axes are at right angles.
[[nodiscard]] double layerMm(const Grid& grid);
/// No segment from inside a block leaves the blocks next to it, nor do the voxels its values are made from.
[[nodiscard]] double longestImportanceStepMm(const Grid& grid, Filter filter);
/// Largest deviation from a line that a tolerance stands for, as a part of the data's range.
[[nodiscard]] double importanceTolerance(const Quality& quality);
/// What a field's kinks at voxel planes count: 1, or 0 where it has none.
[[nodiscard]] double kinkWeight(Filter filter);
/// The step from a block, between the two lengths.
[[nodiscard]] double importanceStepMm(glm::vec2 bend, Filter filter, double tolerance, double layer,
                                      double shortest, double longest);

}  // namespace pellucid::renderer
