// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "scene/result.h"

namespace pellucid {

/// An oriented voxel grid in the patient frame: DICOM LPS (x to the patient's left, y to posterior, z to
/// superior), mm. Integer index points are voxel centres; the volume fills index space [-0.5, size - 0.5] in
/// each axis (whole voxel cells, so that a one-voxel volume has a size). Shear (gantry tilt) and mirroring
/// are allowed.
struct Grid {
    glm::ivec3 size{1, 1, 1};          ///< Voxels along i (fastest), j, k; each >= 1.
    glm::dmat4 patientFromIndex{1.0};  ///< Affine, invertible, last row 0 0 0 1.

    bool operator==(const Grid&) const = default;
};

/// A grid without rotation: spacing in mm, origin = patient position of the centre of voxel (0, 0, 0).
[[nodiscard]] Grid axisAlignedGrid(glm::ivec3 size, glm::dvec3 spacingMm = {1, 1, 1},
                                   glm::dvec3 originMm = {0, 0, 0});

/// Errors: InvalidArgument for a size below 1, an entry that is not finite, a last row that is not 0 0 0 1,
/// or a matrix with no inverse.
[[nodiscard]] Result<void> validate(const Grid& grid);

/// Number of voxels. Errors: InvalidArgument for a size below 1, TooLarge when it does not fit into 64 bits.
[[nodiscard]] Result<std::uint64_t> checkedVoxelCount(glm::ivec3 size);

/// Precondition of everything below: validate(grid) passed.
[[nodiscard]] glm::dmat4 indexFromPatient(const Grid& grid);
/// Texture coordinates: (index + 0.5) / size, so [0, 1]^3 is exactly the volume.
[[nodiscard]] glm::dmat4 textureFromIndex(const Grid& grid);
[[nodiscard]] glm::dmat4 textureFromPatient(const Grid& grid);
[[nodiscard]] glm::dmat4 patientFromTexture(const Grid& grid);

[[nodiscard]] glm::dvec3 transformPoint(const glm::dmat4& matrix, glm::dvec3 point);
[[nodiscard]] glm::dvec3 transformVector(const glm::dmat4& matrix, glm::dvec3 vector);

/// Distance in mm between neighbouring voxel centres along i, j and k (column lengths of patientFromIndex).
[[nodiscard]] glm::dvec3 spacingMm(const Grid& grid);
/// Arithmetic mean of the three spacings: the default unit length of extinction.
[[nodiscard]] double meanSpacingMm(const Grid& grid);
[[nodiscard]] double smallestSpacingMm(const Grid& grid);
/// Patient position of the middle of the volume. Rendering coordinates are relative to it.
[[nodiscard]] glm::dvec3 centreMm(const Grid& grid);
/// The eight outer corners in the patient frame, i fastest.
[[nodiscard]] std::array<glm::dvec3, 8> cornersMm(const Grid& grid);
/// Radius in mm of the sphere about centreMm that holds the volume.
[[nodiscard]] double radiusMm(const Grid& grid);
/// True when the columns are not perpendicular to each other within `tolerance` (cosine).
[[nodiscard]] bool isSheared(const Grid& grid, double tolerance = 1e-4);

/// The patient-axis letter (L R P A S I) that a direction in the patient frame mostly points to, then the
/// next ones in order of dominance while they matter (cosine > 0.2): "A", "AL", "LAS". Empty for a direction
/// that is zero or not finite.
[[nodiscard]] std::string orientationLetters(glm::dvec3 directionMm);

}  // namespace pellucid
