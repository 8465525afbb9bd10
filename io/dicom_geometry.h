// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/result.h"

namespace pellucid::io {

/// Where one slice lies, as its file says. Patient frame: DICOM LPS, mm.
struct SlicePlacement {
    std::string name;            ///< For messages: the file name.
    glm::ivec2 size{0, 0};       ///< Columns, rows.
    glm::dvec2 spacingMm{0, 0};  ///< Between columns (along a row), between rows. PixelSpacing (0028,0030)
                                 ///< has them the other way round: row spacing first.
    glm::dvec3 positionMm{0};    ///< Centre of the first pixel: ImagePositionPatient.
    glm::dvec3 rowDirection{
        0};  ///< Towards growing column index: the first triple of ImageOrientationPatient.
    glm::dvec3 columnDirection{0};
    std::optional<double> statedStepMm;  ///< SpacingBetweenSlices, only compared with the positions.
    std::optional<double> thicknessMm;   ///< SliceThickness: how thick, not how far apart.
    std::optional<double> tiltDeg;       ///< GantryDetectorTilt, only compared with the positions.
};

/// How the slices of a series make one grid.
struct SeriesGeometry {
    std::vector<std::size_t> order;    ///< Slice k of the volume is order[k] of the input.
    glm::dmat4 patientFromIndex{1.0};  ///< Sheared when the slices step off their normal.
    double stepMm = 0.0;               ///< Between neighbouring slices along their normal.
    double tiltDeg = 0.0;         ///< Angle between the step from slice to slice and the normal, in [0, 90).
    double worstOffGridMm = 0.0;  ///< Farthest that a slice lies from its place on the grid.
    std::vector<Warning> warnings;
};

/// Orders slices by their position along the normal (row x column direction) and fits equal steps through the
/// first and last position. A slice may lie off its place by 5 % of the step (a warning beyond rounding):
/// less than a twentieth of a slice is below what interpolation between slices can show, and tables that
/// round positions to 0.1 mm stay within it from 1 mm steps on. 0.02 mm is always allowed (at most a quarter
/// of the step): positions written with two decimals are rounded by up to 0.005 mm per component, thus
/// sqrt(3) * 0.005 mm = 0.009 mm at either end of a comparison.
/// A single slice gets SpacingBetweenSlices, SliceThickness or 1 mm as its step, with a warning.
///
/// Errors. Corrupt: numbers that are not finite, directions that are not unit length or not perpendicular
/// within 1e-3. Inconsistent: sizes, pixel spacings or orientations differ (by more than a tenth of a pixel
/// at the far corner), several slices at one position, missing slices (between which, how large the gap, the
/// step of the rest), uneven steps (smallest and largest and where), slices beside the line of the others.
[[nodiscard]] Result<SeriesGeometry> placeSlices(std::span<const SlicePlacement> slices);

}  // namespace pellucid::io
